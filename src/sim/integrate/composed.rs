//! Shares of a step in which a symmetric method of order 2 is taken to make one of a higher order.

/// One step of the method itself.
pub(crate) static SINGLE: [f64; 1] = [1.0];

/// Five steps of a symmetric method of order 2 that make one of order 4.
/// Source: R. I. McLachlan, SIAM J. Sci. Comput. 16, 151 (1995), table 2.
pub(crate) static COMPOSED_4: [f64; 5] =
    [0.28, 0.625_466_428_467_670_1, -0.810_932_856_935_340_1, 0.625_466_428_467_670_1, 0.28];

/// Nine steps of a symmetric method of order 2 that make one of order 6.
/// Source: W. Kahan and R.-C. Li, Math. Comp. 66, 1089 (1997), s9odr6a.
pub(crate) static COMPOSED_6: [f64; 9] = [
    0.392_161_444_007_314_1,
    0.332_599_136_789_359_44,
    -0.706_246_172_557_639_4,
    0.082_213_596_293_550_8,
    0.798_543_990_934_829_9,
    0.082_213_596_293_550_8,
    -0.706_246_172_557_639_4,
    0.332_599_136_789_359_44,
    0.392_161_444_007_314_1,
];
