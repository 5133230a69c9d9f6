//! Messages with poses, in the serialization of ROS 1 and in the common data representation (CDR) of ROS 2.

use glam::{DQuat, DVec3};

use crate::ExportError;
use crate::bytes::{Bytes, text};
use crate::pose_lines::NANOS;

/// What a message holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// A header and a pose; a covariance may follow.
    Pose,
    /// A header, the name of the body, and a pose or transform; more may follow.
    Body,
    /// A list of headers, names of bodies and transforms.
    Transforms,
}

impl Kind {
    /// The kind of a message type, such as `nav_msgs/Odometry` or `nav_msgs/msg/Odometry`.
    pub(super) fn of(name: &str) -> Option<Self> {
        match name.replace("/msg/", "/").as_str() {
            "geometry_msgs/PoseStamped" | "geometry_msgs/PoseWithCovarianceStamped" => Some(Self::Pose),
            "nav_msgs/Odometry" | "geometry_msgs/TransformStamped" => Some(Self::Body),
            "tf2_msgs/TFMessage" | "tf/tfMessage" => Some(Self::Transforms),
            _ => None,
        }
    }
}

/// A topic with poses.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Topic {
    pub(super) name: String,
    pub(super) kind: Kind,
    pub(super) encoding: Encoding,
}

/// Takes messages in file order: the topic and the message.
pub(super) type Visit<'a> = dyn FnMut(&Topic, &[u8]) -> Result<(), ExportError> + 'a;

/// How the fields of a message are laid out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    /// Little-endian, without gaps.
    Ros1,
    /// Aligned to the size of each number, behind four bytes that name the order of bytes.
    Cdr,
}

/// A pose with its header, not checked.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Stamped {
    pub(super) time_secs: f64,
    /// The frame that the pose is in.
    pub(super) frame: String,
    /// The body, of a message that names it.
    pub(super) child: Option<String>,
    pub(super) position: DVec3,
    /// As the message holds it: of any length.
    pub(super) rotation: DQuat,
}

/// The poses of a message.
pub(super) fn read(kind: Kind, encoding: Encoding, message: &[u8]) -> Result<Vec<Stamped>, ExportError> {
    let mut fields = Fields::new(encoding, message)?;
    if kind != Kind::Transforms {
        return Ok(vec![fields.stamped(kind == Kind::Body)?]);
    }
    (0..fields.u32()?).map(|_| fields.stamped(true)).collect()
}

/// Reads the fields of a message in order.
struct Fields<'a> {
    bytes: Bytes<'a>,
    encoding: Encoding,
    is_big_endian: bool,
    /// Where alignment counts from.
    start: usize,
}

impl<'a> Fields<'a> {
    fn new(encoding: Encoding, message: &'a [u8]) -> Result<Self, ExportError> {
        let mut bytes = Bytes::new(message);
        let is_big_endian = match encoding {
            Encoding::Ros1 => false,
            Encoding::Cdr => match bytes.array::<4>()? {
                [0, order @ (0 | 1), ..] => order == 0,
                [a, b, ..] => {
                    return Err(ExportError::NotReadable {
                        format: "ros",
                        reason: format!("messages in the representation {a:02x} {b:02x}, and not in plain CDR"),
                    });
                }
            },
        };
        let start = bytes.position();
        Ok(Self { bytes, encoding, is_big_endian, start })
    }

    fn number<const N: usize>(&mut self) -> Result<[u8; N], ExportError> {
        if self.encoding == Encoding::Cdr {
            self.bytes.align(self.start, N)?;
        }
        let mut number: [u8; N] = self.bytes.array()?;
        if self.is_big_endian {
            number.reverse();
        }
        Ok(number)
    }

    fn u32(&mut self) -> Result<u32, ExportError> {
        Ok(u32::from_le_bytes(self.number()?))
    }

    fn vector(&mut self) -> Result<DVec3, ExportError> {
        let mut next = || Ok::<f64, ExportError>(f64::from_le_bytes(self.number()?));
        Ok(DVec3::new(next()?, next()?, next()?))
    }

    fn text(&mut self) -> Result<String, ExportError> {
        let num = self.u32()?;
        let offset = self.bytes.position();
        let bytes = self.bytes.take(num.into())?;
        // CDR counts the zero at the end.
        let bytes = if self.encoding == Encoding::Cdr { bytes.strip_suffix(&[0]).unwrap_or(bytes) } else { bytes };
        text(bytes, offset)
    }

    /// A header, the name of a body where there is one, and a pose.
    fn stamped(&mut self, has_child: bool) -> Result<Stamped, ExportError> {
        if self.encoding == Encoding::Ros1 {
            // The number of the message.
            self.u32()?;
        }
        let (secs, nanos) = (self.u32()?, self.u32()?);
        let frame = self.text()?;
        let child = if has_child { Some(self.text()?) } else { None };
        let position = self.vector()?;
        let [x, y, z] = self.vector()?.to_array();
        let rotation = DQuat::from_xyzw(x, y, z, f64::from_le_bytes(self.number()?));
        Ok(Stamped { time_secs: f64::from(secs) + f64::from(nanos) / NANOS, frame, child, position, rotation })
    }
}
