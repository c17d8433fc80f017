//! What can go wrong on the way to a picture.

/// A picture that cannot be drawn.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RenderError {
    /// There is no GPU and no software driver.
    #[error(
        "no GPU driver found ({reason}): install one, or a software driver (Debian and Ubuntu: apt-get install mesa-vulkan-drivers libvulkan1)"
    )]
    NoAdapter {
        /// What the search said.
        reason: String,
    },
    /// The driver would not open the GPU.
    #[error("the GPU `{adapter}` cannot be used: {reason}")]
    NoDevice {
        /// Its name.
        adapter: String,
        /// What the driver said.
        reason: String,
    },
    /// A picture larger than the driver draws, or of no size.
    #[error("{width} x {height} pixels cannot be drawn: give 1 to {most} each way")]
    Size {
        /// Width asked for `[px]`.
        width: u32,
        /// Height asked for `[px]`.
        height: u32,
        /// Most that the driver draws `[px]`.
        most: u32,
    },
    /// A picture with more pixels than the driver's buffers hold.
    #[error(
        "{width} x {height} pixels are {bytes} bytes, more than this GPU's buffers hold ({most}): draw a smaller picture"
    )]
    Pixels {
        /// Width asked for `[px]`.
        width: u32,
        /// Height asked for `[px]`.
        height: u32,
        /// How many bytes it takes to read the picture back.
        bytes: u64,
        /// The most.
        most: u64,
    },
    /// More points or bonds than the driver's buffers hold.
    #[error("{bytes} bytes of {what} are more than this GPU's buffers hold ({most}): use a smaller scene")]
    TooLarge {
        /// What they are.
        what: &'static str,
        /// How many bytes.
        bytes: u64,
        /// The most.
        most: u64,
    },
    /// The driver gave up.
    #[error("the GPU was lost: {reason}")]
    Lost {
        /// What the driver said.
        reason: String,
    },
}
