//! How far the mesh of a picture is, seen from another thread, and a way to stop it.

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use super::PictureError;
use super::settings::MAX_POINTS;

/// What is being done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// The file is read.
    Read,
    /// Ink is told from paper.
    Ink,
    /// Contours and strokes are traced.
    Outlines,
    /// The contours are filled.
    Triangles,
    /// Strokes become ropes, and all is put together.
    Bonds,
}

impl Stage {
    /// All, in order.
    pub const ALL: [Stage; 5] = [Stage::Read, Stage::Ink, Stage::Outlines, Stage::Triangles, Stage::Bonds];

    /// The same in words, for whoever waits.
    pub fn words(self) -> &'static str {
        match self {
            Stage::Read => "reading the picture",
            Stage::Ink => "telling ink from paper",
            Stage::Outlines => "tracing outlines and strokes",
            Stage::Triangles => "making triangles",
            Stage::Bonds => "making bonds",
        }
    }

    /// How much of the work is usually done when it begins `[1]`.
    pub fn share(self) -> f32 {
        match self {
            Stage::Read => 0.0,
            Stage::Ink => 0.1,
            Stage::Outlines => 0.15,
            Stage::Triangles => 0.7,
            Stage::Bonds => 0.9,
        }
    }
}

/// What is told of each stage as it begins.
type Word = Arc<dyn Fn(Stage) + Send + Sync>;

/// Watches a mesh being made; copies watch the same one.
#[derive(Clone)]
pub struct Watch {
    stage: Arc<AtomicUsize>,
    is_stopped: Arc<AtomicBool>,
    word: Option<Word>,
    most_points: u64,
    /// A spacing that makes few enough points `[px]`; 0 until one is known.
    would_do: Arc<AtomicUsize>,
}

impl Default for Watch {
    fn default() -> Self {
        Watch {
            stage: Arc::default(),
            is_stopped: Arc::default(),
            word: None,
            most_points: MAX_POINTS,
            would_do: Arc::default(),
        }
    }
}

impl fmt::Debug for Watch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Watch({:?})", self.stage())
    }
}

impl Watch {
    /// The same, that tells each stage as it begins.
    pub fn with_word(self, word: impl Fn(Stage) + Send + Sync + 'static) -> Self {
        Watch { word: Some(Arc::new(word)), ..self }
    }

    /// The same, that lets meshes have so many points, by an estimate before they are made; [`MAX_POINTS`] at most.
    pub fn with_most_points(self, count: u64) -> Self {
        Watch { most_points: count.min(MAX_POINTS), ..self }
    }

    /// What is being done.
    pub fn stage(&self) -> Stage {
        Stage::ALL[self.stage.load(Ordering::Relaxed).min(Stage::ALL.len() - 1)]
    }

    /// Asks for an end: the next stage does not begin.
    pub fn stop(&self) {
        self.is_stopped.store(true, Ordering::Relaxed);
    }

    /// Where there were too many points: a spacing that makes few enough `[px]`, if any does.
    pub fn would_do(&self) -> Option<f64> {
        let spacing = self.would_do.load(Ordering::Relaxed);
        (spacing > 0).then_some(spacing as f64)
    }

    /// Keeps what an error advises.
    pub(super) fn note(&self, error: &PictureError) {
        if let PictureError::TooManyPoints { would_do: Some(spacing), .. } = error {
            self.would_do.store(spacing.ceil() as usize, Ordering::Relaxed);
        }
    }

    /// Whether it is to stop.
    pub fn is_stopped(&self) -> bool {
        self.is_stopped.load(Ordering::Relaxed)
    }

    /// Most points of a mesh.
    pub(super) fn most_points(&self) -> u64 {
        self.most_points
    }

    /// A stage begins.
    ///
    /// Errors: it is to stop.
    pub fn enter(&self, stage: Stage) -> Result<(), PictureError> {
        if self.is_stopped() {
            return Err(PictureError::Stopped);
        }
        self.stage.store(stage as usize, Ordering::Relaxed);
        self.word.iter().for_each(|word| word(stage));
        Ok(())
    }
}
