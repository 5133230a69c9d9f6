use std::ffi::OsString;
use std::path::{Path, PathBuf};

use super::VideoError;

/// Names of numbered pictures: a path whose file name contains one `%d` or `%05d` as in `printf`, and `%%` for a
/// percent sign. Only the file name is a pattern; folder names are used literally.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FramePattern {
    folder: PathBuf,
    before: String,
    after: String,
    min_digits: usize,
}

impl FramePattern {
    /// Parses a pattern.
    ///
    /// # Errors
    /// [`VideoError::BadPattern`] unless the file name is UTF-8 and contains exactly one frame number of at most 20
    /// digits.
    pub fn parse(path: &Path) -> Result<Self, VideoError> {
        let bad = |reason| VideoError::BadPattern { reason, path: path.to_owned() };
        let name = path.file_name().ok_or(bad("no file name"))?;
        let name = name.to_str().ok_or(bad("the file name is not UTF-8, expected UTF-8 in a frame pattern"))?;
        let mut texts = vec![String::new()];
        let mut min_digits = 1;
        let mut rest = name.chars();
        while let Some(c) = rest.next() {
            if c != '%' {
                texts.last_mut().ok_or(bad("no file name"))?.push(c);
                continue;
            }
            let digits: String = rest.clone().take_while(char::is_ascii_digit).collect();
            match rest.nth(digits.len()) {
                Some('%') if digits.is_empty() => texts.last_mut().ok_or(bad("no file name"))?.push('%'),
                Some('d') if digits.is_empty() || digits.starts_with('0') => {
                    min_digits = digits.parse().unwrap_or(1);
                    texts.push(String::new());
                }
                _ => return Err(bad("the frame pattern has another % sequence, expected %d, %05d or %%")),
            }
        }
        let [before, after] = <[String; 2]>::try_from(texts)
            .map_err(|_| bad("none or several frame numbers, expected exactly one %d"))?;
        if min_digits > 20 {
            return Err(bad("a frame number of more than 20 digits, expected at most 20"));
        }
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        Ok(Self { folder, before, after, min_digits })
    }

    /// The file of one frame.
    pub fn path(&self, frame_idx: usize) -> PathBuf {
        let digits = self.min_digits;
        self.folder.join(OsString::from(format!("{}{frame_idx:0digits$}{}", self.before, self.after)))
    }

    /// The frame number in a file name of this pattern; `None` for other names.
    pub fn number_of(&self, name: &str) -> Option<usize> {
        let digits = name.strip_prefix(&self.before)?.strip_suffix(&self.after)?;
        let number = digits.parse().ok().filter(|_| digits.bytes().all(|byte| byte.is_ascii_digit()))?;
        (self.path(number).file_name()?.to_str()? == name).then_some(number)
    }

    /// Whether the pictures are `OpenEXR` files.
    pub fn is_exr(&self) -> bool {
        self.after.to_ascii_lowercase().ends_with(".exr")
    }

    /// The folder of all frames; empty for the working folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }
}
