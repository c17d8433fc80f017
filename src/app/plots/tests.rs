//! Series without a window: a world that is played, gone back in and edited.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]

use super::series::MOST;
use super::{Plots, Quantity, Series, Subject};
use crate::app::player::{Measured, Order, Probe, Probed, Shown, Stage};
use crate::history::{DeleteKeys, Do};
use crate::scene::Scene;
use crate::sim::{Energies, PointId};

const SCENE: &str = r#"{"wobble": 1, "gravity": [0, -9.81], "method": {"substep": 0.005},
    "points": {"position": [[0, 1], [1, 2]], "velocity": [[1, 0], [0, 3]]},
    "bounds": {"min": [-5, -5], "max": [5, 5], "restitution": 1}}"#;

/// A world with its plots.
struct Played {
    stage: Stage,
    shown: Shown,
    plots: Plots,
}

impl Played {
    fn new() -> Self {
        let mut stage = Stage::new(Scene::parse(SCENE, "x.json").unwrap().into()).unwrap();
        stage.obey(Order::Watch(Some([None; 2])));
        Played { stage, shown: Shown::default(), plots: Plots::new(1.0) }
    }

    /// Does what is asked and takes what comes of it.
    fn ask(&mut self, order: Order) -> [bool; 2] {
        self.stage.obey(order);
        self.stage.show(&mut self.shown);
        self.plots.take(&self.shown)
    }

    fn play(&mut self, frames: usize) {
        (0..frames).for_each(|_| _ = self.ask(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false }));
    }

    fn toggle(&mut self, point: u32) {
        self.plots.toggle(PointId(point), |_| false);
        self.ask(Order::Watch(Some(self.plots.probes())));
    }

    fn times(&self) -> Vec<f64> {
        self.plots.series().iter().map(|measured| measured.time).collect()
    }

    /// How many measurements there are at either place.
    fn probed(&self) -> [usize; 2] {
        [0, 1].map(|place| self.plots.series().iter().filter(|measured| measured.probes[place].is_some()).count())
    }
}

fn ascends(times: &[f64]) -> bool {
    times.windows(2).all(|pair| pair[0] < pair[1])
}

fn at(time: f64) -> Measured {
    Measured {
        time,
        energies: Energies { kinetic: time, springs: 1.0, gravity: -1.0, ..Energies::default() },
        ..Measured::default()
    }
}

#[test]
fn a_series_ascends_is_bounded_and_reaches_back_evenly() {
    // At 60 Hz and a pace of 1/8, then of 4.
    for step in [1.0 / 480.0, 4.0 / 60.0] {
        let mut series = Series::new(20.0);
        (0..20_000).for_each(|k| _ = series.push(at(f64::from(k) * step)));
        let times: Vec<f64> = series.iter().map(|measured| measured.time).collect();
        assert!(ascends(&times) && times.len() <= MOST, "{} of {step} s", times.len());
        let (first, last) = (times[0], times[times.len() - 1]);
        assert_eq!(last, 19_999.0 * step, "the present is there");
        assert!((19.9..=20.0).contains(&(last - first)), "{first} {last} s");
        let widest = times.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
        assert!(widest < step.max(20.0 / 1000.0) + 1e-9, "{widest} s");
    }
}

#[test]
fn what_is_measured_anew_at_a_time_takes_the_place_of_what_was() {
    let mut series = Series::new(20.0);
    [0.0, 1.0, 2.0, 1.0].into_iter().for_each(|time| assert!(series.push(at(time))));
    let edited = Measured { energies: Energies { kinetic: 7.0, ..Energies::default() }, ..at(1.0) };
    assert!(series.push(edited));
    let broken = Energies { kinetic: f64::NAN, ..Energies::default() };
    assert!(!series.push(Measured { energies: broken, ..at(3.0) }), "of no finite number no curve can be drawn");
    let kinetic: Vec<f64> = series.iter().map(|measured| measured.energies.kinetic).collect();
    assert_eq!(kinetic, [0.0, 7.0]);
}

#[test]
fn an_error_that_is_known_stays_while_its_time_is_measured_anew() {
    let mut series = Series::new(20.0);
    let probed = |x: f64| Measured {
        probes: [Some(Probed::new(Probe::Point(PointId(0)), [[x, 0.0, 0.0], [0.0; 3]])), None],
        ..at(1.0)
    };
    assert!(series.push(probed(2.0)) && series.know(1.0, [Some(0.25), None]));
    let error = |series: &Series| series.iter().last().unwrap().probes[0].unwrap().error;
    assert!(series.push(probed(2.0)));
    assert_eq!(error(&series), Some(0.25), "as in every frame of a pause");
    assert!(series.push(probed(3.0)));
    assert_eq!(error(&series), None, "it was put elsewhere");
}

#[test]
fn going_back_cuts_off_what_was_seen_and_the_curve_goes_on_from_there() {
    let mut played = Played::new();
    played.play(60);
    let before = played.times();
    assert!(ascends(&before) && before.len() > 50 && *before.last().unwrap() == played.shown.figures.time);
    let half = 0.5 * played.shown.figures.time;
    assert_eq!(played.ask(Order::GoTo(half, None)), [true, false]);
    let back = played.times();
    assert_eq!(*back.last().unwrap(), played.shown.figures.time);
    assert!((*back.last().unwrap() - half).abs() < 0.005, "{back:?}");
    let kept = before.iter().filter(|time| **time < back[back.len() - 1] - 1e-9).copied();
    assert!(kept.eq(back[..back.len() - 1].iter().copied()), "what was before stays");
    played.play(10);
    assert!(ascends(&played.times()) && played.times().len() > back.len());
    // Also in frames in which nothing is measured.
    played.ask(Order::Watch(None));
    assert_eq!(played.ask(Order::GoTo(0.25 * half, None)), [true, false]);
    assert!(played.times().iter().all(|time| *time <= played.shown.figures.time));
    played.ask(Order::Watch(Some([None; 2])));
    played.ask(Order::Reset);
    assert_eq!(played.times(), [0.0]);
    // Another scene begins anew.
    played.play(5);
    played.toggle(0);
    played.plots.begin(2.0);
    assert!(played.times().is_empty() && played.plots.probes() == [None; 2]);
}

#[test]
fn a_pause_adds_nothing() {
    let mut played = Played::new();
    played.play(10);
    let before = played.times();
    played.ask(Order::Play(false));
    played.play(10);
    assert_eq!(played.times(), before);
}

#[test]
fn probes_are_put_on_taken_off_and_drop_out_with_their_points() {
    let mut played = Played::new();
    played.play(10);
    played.toggle(0);
    assert_eq!(played.plots.subject, Subject::Probes, "what was asked for is seen");
    played.play(10);
    played.toggle(1);
    played.play(10);
    assert_eq!(played.probed(), [24, 13], "from where it was put on");
    let last = played.plots.series().iter().last().unwrap().probes[1].unwrap();
    assert_eq!(
        [Quantity::X, Quantity::Y].map(|of| of.of(&last)),
        [0, 1].map(|axis| Some(played.shown.current.view().get(2 + axis)))
    );
    assert!(Quantity::Speed.of(&last) > Some(0.0) && Quantity::Strain.of(&last).is_none());
    played.plots.subject = Subject::Phase;
    played.toggle(0);
    assert_eq!((played.plots.probes(), played.probed()[0]), ([None, Some(PointId(1).into())], 0));
    assert_eq!(played.plots.subject, Subject::Probes, "one alone is against nothing");
    let keys = DeleteKeys { points: vec![1], ..DeleteKeys::default() };
    let lost = played.ask(Order::Give(vec![Do::Delete(keys)], Some("delete")));
    assert_eq!((lost[1], played.plots.probes(), played.probed()), (true, [None; 2], [0; 2]));
    assert_eq!(played.plots.subject, Subject::Energies);
}

#[test]
fn a_third_probe_takes_the_place_of_the_second() {
    let mut plots = Plots::new(1.0);
    [4, 5, 6].into_iter().for_each(|point| plots.toggle(PointId(point), |_| false));
    assert_eq!(plots.probes(), [4, 6].map(|point| Some(PointId(point).into())));
}

#[test]
fn an_orbit_stays_one_when_a_bond_is_probed_too() {
    let mut plots = Plots::new(1.0);
    plots.toggle(PointId(0), |_| false);
    plots.choose_orbit(Quantity::Y);
    plots.toggle(Probe::Bond(3), |_| false);
    assert_eq!((plots.subject, plots.quantity), (Subject::Orbit, Quantity::Y));
}

#[test]
fn it_is_said_why_a_force_against_each_other_has_no_curve() {
    let force = |probes: [Probe; 2]| {
        let mut plots = Plots::new(1.0);
        probes.into_iter().for_each(|probe| plots.toggle(probe, |_| true));
        (plots.subject, plots.quantity) = (Subject::Phase, Quantity::Force);
        plots
    };
    let mixed = force([PointId(1).into(), Probe::Bond(3)]);
    assert!(mixed.why_empty().is_some_and(|why| why.starts_with("A point has no force")));
    assert_eq!([0, 1].map(|place| mixed.has_curve(place)), [false, true]);
    assert_eq!(force([Probe::Bond(2), Probe::Bond(3)]).why_empty(), None, "nothing was measured yet");
    let speed = Plots { quantity: Quantity::Speed, ..mixed };
    assert_eq!(speed.why_empty(), None);
}

#[test]
fn a_probe_opens_on_what_changes_of_it() {
    let opened = |probe: Probe, is_rigid: bool| {
        let mut plots = Plots::new(1.0);
        plots.toggle(probe, |_| is_rigid);
        plots
    };
    assert_eq!(opened(PointId(3).into(), false).quantity, Quantity::Speed);
    assert_eq!(opened(Probe::Bond(3), false).quantity, Quantity::Strain);
    let mut plots = opened(Probe::Bond(3), true);
    assert_eq!(plots.quantity, Quantity::Force, "its strain is 0 for good");
    plots.toggle(Probe::Bond(3), |_| true);
    plots.quantity = Quantity::X;
    plots.toggle(PointId(1), |_| false);
    assert_eq!(plots.quantity, Quantity::X, "what was chosen stays where there is such a thing");
}

#[test]
fn what_is_of_two_is_one_curve_and_goes_with_either_of_them() {
    let mut plots = Plots::new(1.0);
    plots.toggle(Probe::Bond(0), |_| false);
    assert!(!plots.quantities().any(Quantity::is_of_both), "of one alone");
    plots.toggle(Probe::Bond(1), |_| false);
    plots.choose(Quantity::Between);
    assert_eq!([0, 1].map(|place| plots.has_curve(place)), [true, false]);
    plots.oppose();
    assert_eq!((plots.subject, plots.quantity), (Subject::Phase, Quantity::default()));
    plots.choose(Quantity::Distance);
    assert_eq!(plots.subject, Subject::Probes, "one number is against nothing");
    plots.toggle(Probe::Bond(1), |_| false);
    assert_eq!(plots.quantity, Quantity::default());
}

#[test]
fn an_angle_goes_on_beyond_a_turn() {
    let mut plots = Plots::new(1.0);
    let corner = Probe::Corner([0, 1, 2].map(PointId));
    plots.toggle(corner, |_| false);
    plots.choose(Quantity::Angle);
    for (time, angle) in [(0.0, 300.0), (1.0, 350.0), (2.0, 20.0), (3.0, 340.0)] {
        let probed = Probed { angle: Some(angle), ..Probed::new(corner, [[0.0; 3]; 2]) };
        plots.series.push(Measured { probes: [Some(probed), None], ..at(time) });
    }
    assert_eq!(plots.over_time(0), [[0.0, 300.0], [1.0, 350.0], [2.0, 380.0], [3.0, 340.0]]);
}

#[test]
fn what_was_measured_of_another_point_is_not_taken() {
    let mut played = Played::new();
    played.toggle(0);
    // The world does not know of it yet.
    played.plots.toggle(PointId(0), |_| false);
    played.plots.toggle(PointId(1), |_| false);
    played.play(1);
    assert_eq!(played.probed(), [0; 2]);
}

#[test]
fn a_table_has_a_header_and_a_row_for_each_measurement() {
    let mut played = Played::new();
    played.play(5);
    played.toggle(1);
    played.play(5);
    let mut bytes = Vec::new();
    played.plots.series().write_csv(2, &mut bytes).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), 1 + played.times().len());
    let energies = ["kinetic_J", "springs_J", "angles_J", "areas_J", "surfaces_J", "gravity_J", "sum_J"];
    assert_eq!(rows[0][..10], [&["time_s"], &energies[..], &["largest_strain", "point_1"]].concat());
    assert!(rows.iter().all(|row| row.len() == rows[0].len()), "{text}");
    for (row, measured) in rows[1..].iter().zip(played.plots.series().iter()) {
        assert_eq!(
            row[..2].iter().map(|cell| cell.parse().unwrap()).collect::<Vec<f64>>(),
            [measured.time, measured.energies.kinetic]
        );
        let Some(probed @ Probed { velocity, .. }) = measured.probes[0] else {
            assert_eq!(row[9..], [""; 25]);
            continue;
        };
        assert_eq!((row[9], row[13].parse()), ("1", Ok(probed.speed())));
        let components: Vec<f64> = row[14..16].iter().map(|word| word.parse().unwrap()).collect();
        assert_eq!(components, velocity[..2], "the plane has no third one");
    }
    let mut space = Vec::new();
    played.plots.series().write_csv(3, &mut space).unwrap();
    let space = String::from_utf8(space).unwrap();
    assert!(space.contains(",z_1_m,") && space.contains(",vz_2_m/s,") && !text.contains("z_1"), "{space}");
    assert!(space.lines().all(|line| line.split(',').count() == rows[0].len() + 4), "{space}");
    assert!(rows[1][9].is_empty() && !rows[rows.len() - 1][9].is_empty());
}

#[test]
fn the_present_goes_once_something_follows_and_is_no_row_of_a_table() {
    let mut series = Series::new(20.0);
    let rows = |series: &Series| {
        let mut bytes = Vec::new();
        series.write_csv(2, &mut bytes).unwrap();
        String::from_utf8(bytes).unwrap().lines().count() - 1
    };
    let times = |series: &Series| series.iter().map(|measured| measured.time).collect::<Vec<f64>>();
    let passing = |time: f64| Measured { is_passing: true, ..at(time) };
    [at(0.0), at(0.1), passing(0.15)].into_iter().for_each(|measured| assert!(series.push(measured)));
    assert_eq!((times(&series), rows(&series)), (vec![0.0, 0.1, 0.15], 2));
    series.push(passing(0.17));
    assert_eq!(times(&series), [0.0, 0.1, 0.17]);
    series.push(at(0.2));
    assert_eq!((times(&series), rows(&series)), (vec![0.0, 0.1, 0.2], 3));
    // Copies of times long ago are no neighbours of what was measured at its time.
    series.fill(vec![passing(-0.3), passing(0.095), at(0.05)]);
    assert_eq!((times(&series), rows(&series)), (vec![-0.3, 0.0, 0.05, 0.1, 0.2], 5));
}

#[test]
fn what_was_before_is_put_between_what_is_there() {
    let mut series = Series::new(20.0);
    (0..10).for_each(|k| _ = series.push(at(5.0 + 0.1 * f64::from(k))));
    series.fill((0..80).map(|k| at(0.1 * f64::from(k))).collect());
    let times: Vec<f64> = series.iter().map(|measured| measured.time).collect();
    assert!(ascends(&times) && times.len() == 60, "each time once, and none after the present: {times:?}");
    series.fill((0..90_000).map(|k| at(0.001 * f64::from(k) - 84.1)).collect());
    let times: Vec<f64> = series.iter().map(|measured| measured.time).collect();
    assert!(ascends(&times) && times.len() <= MOST && times[0] >= 5.9 - 20.0, "{} from {}", times.len(), times[0]);
}
