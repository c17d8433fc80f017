//! What drawing cost, counted.

/// Work that drawing did: a still scene adds nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RenderCounters {
    /// Buffers written.
    pub uploads: u64,
    /// Bytes written to them.
    pub bytes_uploaded: u64,
    /// Bytes that the buffers of the world hold now: they grow, and are kept.
    pub bytes_held: u64,
    /// Command buffers submitted.
    pub submits: u64,
    /// Pictures drawn.
    pub frames_drawn: u64,
    /// Draw calls in them.
    pub draws: u64,
    /// Bonds that were drawn as strokes.
    pub bonds_drawn: u64,
    /// Bonds that were drawn as dots, for themselves and their neighbours.
    pub dots_drawn: u64,
    /// Triangles of skins that were drawn.
    pub triangles_drawn: u64,
    /// Triangles of obstacles whose cover was added up: none where obstacles and camera are as they were.
    pub obstacle_triangles_drawn: u64,
    /// Points that were drawn.
    pub points_drawn: u64,
    /// Points that were looked at to find out which parts of a scene are in view.
    pub points_bounded: u64,
}

impl RenderCounters {
    /// The work for this world and for another in the same pictures.
    pub(super) fn and(&self, other: &RenderCounters) -> Self {
        let sum = |of: fn(&RenderCounters) -> u64| of(self) + of(other);
        RenderCounters {
            uploads: sum(|counters| counters.uploads),
            bytes_uploaded: sum(|counters| counters.bytes_uploaded),
            bytes_held: sum(|counters| counters.bytes_held),
            draws: sum(|counters| counters.draws),
            bonds_drawn: sum(|counters| counters.bonds_drawn),
            dots_drawn: sum(|counters| counters.dots_drawn),
            triangles_drawn: sum(|counters| counters.triangles_drawn),
            obstacle_triangles_drawn: sum(|counters| counters.obstacle_triangles_drawn),
            points_drawn: sum(|counters| counters.points_drawn),
            points_bounded: sum(|counters| counters.points_bounded),
            submits: self.submits,
            frames_drawn: self.frames_drawn,
        }
    }
}
