//! Explicit Runge-Kutta methods as tables of their coefficients.

/// An explicit Runge-Kutta method: x' = x + h sum b_i k_i, k_i = f(t + c_i h, x + h sum over j < i of a_ij k_j).
///
/// Rows hold (stage, coefficient) of what is not zero.
#[derive(Debug)]
pub(crate) struct Tableau {
    /// a_ij, a row a stage.
    pub(crate) stages: &'static [&'static [(usize, f64)]],
    /// b_i.
    pub(crate) weights: &'static [(usize, f64)],
    /// c_i.
    pub(crate) nodes: &'static [f64],
    /// Largest omega h of an oscillation that does not grow, or grows slowly enough to be of use.
    pub(crate) stability: f64,
    /// Weights of the slopes in two estimates of the error of a step over h, of order 5 and of order 3; `None`: it has none.
    pub(crate) errors: Option<[&'static [(usize, f64)]; 2]>,
}

/// Most coefficients of a row of any table.
pub(crate) const LONGEST_ROW: usize = 9;

/// Explicit Euler: order 1, unstable on every undamped oscillation (it grows by sqrt(1 + (omega h)^2) a step).
pub(crate) static EULER: Tableau =
    Tableau { stages: &[&[]], weights: &[(0, 1.0)], nodes: &[0.0], stability: 1.0, errors: None };

/// The midpoint method: order 2; slowly unstable on undamped oscillations.
/// Source: C. Runge, Math. Ann. 46, 167 (1895).
pub(crate) static RK2: Tableau =
    Tableau { stages: &[&[], &[(0, 0.5)]], weights: &[(1, 1.0)], nodes: &[0.0, 0.5], stability: 1.0, errors: None };

/// The classical method: order 4, stable on oscillations up to omega h = 2.828.
/// Source: W. Kutta, Z. Math. Phys. 46, 435 (1901).
pub(crate) static RK4: Tableau = Tableau {
    stages: &[&[], &[(0, 0.5)], &[(1, 0.5)], &[(2, 1.0)]],
    weights: &[(0, 1.0 / 6.0), (1, 1.0 / 3.0), (2, 1.0 / 3.0), (3, 1.0 / 6.0)],
    nodes: &[0.0, 0.5, 0.5, 1.0],
    stability: 2.5,
    errors: None,
};

/// The method of order 8 of Dormand and Prince in twelve stages.
/// Source: E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed. 1993, II.5 (DOP853).
pub(crate) static RK8: Tableau = Tableau {
    stages: &[
        &[],
        &[(0, 0.05260015195876773)],
        &[(0, 0.0197250569845379), (1, 0.0591751709536137)],
        &[(0, 0.02958758547680685), (2, 0.08876275643042054)],
        &[(0, 0.2413651341592667), (2, -0.8845494793282861), (3, 0.924834003261792)],
        &[(0, 0.037037037037037035), (3, 0.17082860872947386), (4, 0.12546768756682242)],
        &[(0, 0.037109375), (3, 0.17025221101954405), (4, 0.06021653898045596), (5, -0.017578125)],
        &[
            (0, 0.03709200011850479),
            (3, 0.17038392571223998),
            (4, 0.10726203044637328),
            (5, -0.015319437748624402),
            (6, 0.008273789163814023),
        ],
        &[
            (0, 0.6241109587160757),
            (3, -3.3608926294469414),
            (4, -0.868219346841726),
            (5, 27.59209969944671),
            (6, 20.154067550477894),
            (7, -43.48988418106996),
        ],
        &[
            (0, 0.47766253643826434),
            (3, -2.4881146199716677),
            (4, -0.590290826836843),
            (5, 21.230051448181193),
            (6, 15.279233632882423),
            (7, -33.28821096898486),
            (8, -0.020331201708508627),
        ],
        &[
            (0, -0.9371424300859873),
            (3, 5.186372428844064),
            (4, 1.0914373489967295),
            (5, -8.149787010746927),
            (6, -18.52006565999696),
            (7, 22.739487099350505),
            (8, 2.4936055526796523),
            (9, -3.0467644718982196),
        ],
        &[
            (0, 2.273310147516538),
            (3, -10.53449546673725),
            (4, -2.0008720582248625),
            (5, -17.9589318631188),
            (6, 27.94888452941996),
            (7, -2.8589982771350235),
            (8, -8.87285693353063),
            (9, 12.360567175794303),
            (10, 0.6433927460157636),
        ],
    ],
    weights: &[
        (0, 0.054293734116568765),
        (5, 4.450312892752409),
        (6, 1.8915178993145003),
        (7, -5.801203960010585),
        (8, 0.3111643669578199),
        (9, -0.1521609496625161),
        (10, 0.20136540080403034),
        (11, 0.04471061572777259),
    ],
    nodes: &[
        0.0,
        0.05260015195876773,
        0.0789002279381516,
        0.1183503419072274,
        0.2816496580927726,
        0.3333333333333333,
        0.25,
        0.3076923076923077,
        0.6512820512820513,
        0.6,
        0.8571428571428571,
        1.0,
    ],
    stability: 4.0,
    errors: Some([
        &[
            (0, 0.01312004499419488),
            (5, -1.2251564463762044),
            (6, -0.4957589496572502),
            (7, 1.6643771824549864),
            (8, -0.35032884874997366),
            (9, 0.3341791187130175),
            (10, 0.08192320648511571),
            (11, -0.022355307863886294),
        ],
        &[
            (0, 0.054293734116568765 - 0.2440944881889764),
            (5, 4.450312892752409),
            (6, 1.8915178993145003),
            (7, -5.801203960010585),
            (8, 0.3111643669578199 - 0.7338466882816118),
            (9, -0.1521609496625161),
            (10, 0.20136540080403034),
            (11, 0.04471061572777259 - 0.022058823529411766),
        ],
    ]),
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_add_up_to_their_nodes_and_weights_to_one() {
        for table in [&EULER, &RK2, &RK4, &RK8] {
            for (row, node) in table.stages.iter().zip(table.nodes) {
                let sum: f64 = row.iter().map(|(_, a)| a).sum();
                assert!((sum - node).abs() < 1e-13, "{sum} {node}");
            }
            let sum: f64 = table.weights.iter().map(|(_, b)| b).sum();
            assert!((sum - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn no_row_is_longer_than_the_longest() {
        let rows = [&EULER, &RK2, &RK4, &RK8].into_iter().flat_map(|table| table.stages.iter().chain([&table.weights]));
        assert_eq!(rows.map(|row| row.len()).max(), Some(LONGEST_ROW));
    }

    /// sum e_i c_i^(k-1) = 0 up to the order that an estimate has, and not beyond.
    #[test]
    fn estimates_of_errors_vanish_on_what_is_exact() {
        let [of_5, of_3] = RK8.errors.expect("it has estimates");
        let moment = |row: &[(usize, f64)], k: i32| row.iter().map(|&(i, e)| e * RK8.nodes[i].powi(k - 1)).sum::<f64>();
        for k in 1..=5 {
            assert!(moment(of_5, k).abs() < 1e-13, "power {k}: {}", moment(of_5, k));
        }
        for k in 1..=3 {
            assert!(moment(of_3, k).abs() < 1e-13, "power {k}: {}", moment(of_3, k));
        }
        assert!(moment(of_5, 6).abs() > 1e-5 && moment(of_3, 4).abs() > 1e-5);
    }

    /// sum b_i c_i^(k-1) = 1/k: what a method of that order does to polynomials.
    #[test]
    fn weights_integrate_polynomials_up_to_the_order() {
        for (table, order) in [(&EULER, 1), (&RK2, 2), (&RK4, 4), (&RK8, 8)] {
            for k in 1..=order {
                let sum: f64 = table.weights.iter().map(|&(i, b)| b * table.nodes[i].powi(k - 1)).sum();
                assert!((sum - 1.0 / f64::from(k)).abs() < 1e-13, "order {order}, power {k}: {sum}");
            }
        }
    }
}
