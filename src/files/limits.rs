/// Limits on everything that is read from outside. All readers share this one value; flags of commands change fields of it.
///
/// Readers check a size against its limit, and against the bytes that are present, before they allocate for it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Bytes of a scene's file, and of what it unpacks to.
    pub scene_bytes: u64,
    /// Gaussians of a scene.
    pub gaussians: usize,
    /// Bytes of memory that reading a scene may take.
    pub memory_bytes: u64,
    /// Bytes of a text of the program's own: shots, objects, cameras, prompts.
    pub text_bytes: u64,
    /// Bytes of a file of numbers: arrays, clouds, checkpoints, paths of other programs.
    pub array_bytes: u64,
    /// Bytes of a model's file: weights, tokenizer, description.
    pub model_bytes: u64,
    /// Bytes of a header.
    pub header_bytes: usize,
    /// Bytes that a packed byte may unpack to, beyond [`Limits::unpacked_bytes`]. Real scenes reach 3.
    pub ratio: u64,
    /// Bytes that any packed file may unpack to, however small it is.
    pub unpacked_bytes: u64,
    /// Poses of a camera path.
    pub poses: usize,
    /// Lists within lists of a JSON text.
    pub json_depth: usize,
    /// Bytes of memory that a parsed JSON text may take.
    pub json_bytes: u64,
}

impl Limits {
    /// The limits of a program without flags.
    pub const DEFAULT: Self = Self {
        scene_bytes: 8 << 30,
        gaussians: 50_000_000,
        memory_bytes: 32 << 30,
        text_bytes: 64 << 20,
        array_bytes: 1 << 30,
        model_bytes: 256 << 20,
        header_bytes: 64 << 10,
        ratio: 100,
        unpacked_bytes: 16 << 20,
        poses: 4_000_000,
        json_depth: 128,
        json_bytes: 512 << 20,
    };

    /// Bytes that a packed file of `num_bytes` may unpack to.
    pub fn unpacked(&self, num_bytes: usize) -> u64 {
        (num_bytes as u64).saturating_mul(self.ratio).max(self.unpacked_bytes).min(self.scene_bytes)
    }
}

impl Default for Limits {
    fn default() -> Self {
        Self::DEFAULT
    }
}
