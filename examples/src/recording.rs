//! Recordings: the pose of every body at each step, so that collision alone can be replayed.
//!
//! A recording belongs to one scene, of which it holds only the name and size: to play it, build the scene and set the
//! poses. All numbers are little-endian, and floats are kept bit for bit.
//!
//! | part | content |
//! |---|---|
//! | head | [`MAGIC`], 8 bytes; [`VERSION`], u32; dimension, u32; size of the scene, u64; bodies, u32; bytes of the name, u32; the name, UTF-8: of a stage, or of a scene file |
//! | a step | bodies that moved, u32, and as many: number, u32, then the pose; bodies that left, u32, and as many numbers, u32; contacts within margins, u32; contacts that share a point, u32 |
//! | a pose | position, f64 a coordinate; rotation, f32 a number: cosine and sine in the plane, x, y, z, w in space |
//!
//! Steps follow one another to the end of the file. Body numbers are those of the scene. Bodies that do not move take
//! no room.

use crate::playable::Playable;
use asunder::glam::{DVec2, DVec3, Quat};
use asunder::{Pose2, Pose3, Rotation2, Space};
use std::io::{ErrorKind, Read, Write};

/// The first bytes of every recording.
pub const MAGIC: [u8; 8] = *b"asunder\n";

/// The version of the format described above.
pub const VERSION: u32 = 1;

/// The longest name of a scene, in bytes.
const MAX_NAME: u32 = 4096;

/// A pose as numbers, and back, bit for bit.
pub trait Numbers: Sized {
    /// How many numbers a position has, and how many a rotation.
    const COUNTS: [usize; 2];
    /// The numbers of the position, then those of the rotation, which are f32.
    fn numbers(&self) -> impl Iterator<Item = f64>;
    /// The pose of such numbers; `None` where they make no valid pose.
    fn of_numbers(numbers: &[f64]) -> Option<Self>;
}

impl Numbers for Pose2 {
    const COUNTS: [usize; 2] = [2, 2];

    fn numbers(&self) -> impl Iterator<Item = f64> {
        let rotation = [self.rotation().cos(), self.rotation().sin()].map(f64::from);
        self.position().to_array().into_iter().chain(rotation)
    }

    fn of_numbers(numbers: &[f64]) -> Option<Self> {
        let &[x, y, cos, sin] = numbers else { return None };
        Self::new(DVec2::new(x, y), Rotation2::restored(cos as f32, sin as f32).ok()?).ok()
    }
}

impl Numbers for Pose3 {
    const COUNTS: [usize; 2] = [3, 4];

    fn numbers(&self) -> impl Iterator<Item = f64> {
        let rotation = self.rotation().to_array().map(f64::from);
        self.position().to_array().into_iter().chain(rotation)
    }

    fn of_numbers(numbers: &[f64]) -> Option<Self> {
        let &[x, y, z, ref rotation @ ..] = numbers else { return None };
        let rotation: [f64; 4] = rotation.try_into().ok()?;
        Self::new(DVec3::new(x, y, z), Quat::from_array(rotation.map(|number| number as f32))).ok()
    }
}

/// The head of a recording: what it says of its scene.
///
/// ```
/// use asunder::{Pose3, Volume};
/// use asunder_examples::recording::{Head, RecordError, Step, read_head, read_step, write_head, write_step};
/// let head = Head { dimension: 3, size: 20, bodies: 21, name: "stack".to_owned() };
/// let step = Step::<Volume> { moved: vec![(4, Pose3::at([1.0, 2.0, 3.0])?)], left: vec![7], contacts: 3, overlapping: 2 };
/// let mut file = Vec::new();
/// write_head(&mut file, &head)?;
/// write_step(&mut file, &step)?;
///
/// let mut bytes = &file[..];
/// assert_eq!(read_head(&mut bytes)?, head);
/// assert_eq!(read_step::<Volume>(&mut bytes, &head)?, Some(step));
/// assert_eq!(read_step::<Volume>(&mut bytes, &head)?, None, "the end");
/// assert!(matches!(read_head(&mut &file[..9]), Err(RecordError::CutShort)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Head {
    /// 2 or 3.
    pub dimension: u32,
    /// What the scene was built with.
    pub size: u64,
    /// How many bodies it has, scenery included.
    pub bodies: u32,
    /// The name of a stage, or the path of a scene file.
    pub name: String,
}

/// What happened in a step.
#[derive(Clone, Debug, PartialEq)]
pub struct Step<S: Space> {
    /// Bodies that moved, by number, and where they are now.
    pub moved: Vec<(u32, S::Pose)>,
    /// Bodies that left the level.
    pub left: Vec<u32>,
    /// Contacts within margins after the step, at the bodies' poses; speculative ones are not counted.
    pub contacts: u32,
    /// Those of them that overlap.
    pub overlapping: u32,
}

/// What is wrong with a recording.
#[derive(Debug)]
pub enum RecordError {
    /// An error of the file system.
    Io(std::io::Error),
    /// It does not begin with [`MAGIC`].
    NoRecording,
    /// It is of another version of the format.
    Version {
        /// The version it has.
        found: u32,
    },
    /// It ends within its head or a step.
    CutShort,
    /// The head makes no sense.
    Head {
        /// What is wrong with it.
        part: &'static str,
    },
    /// A body number is not one of the scene.
    Body {
        /// The number it has.
        found: u32,
    },
    /// More bodies are listed in a step than the scene has.
    TooMany {
        /// The count it has.
        found: u32,
    },
    /// The numbers of a pose make no valid pose.
    Pose {
        /// The body.
        body: u32,
    },
}

impl std::fmt::Display for RecordError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Io(error) => write!(f, "{error}"),
            Self::NoRecording => write!(f, "this is no recording: it does not begin with \"asunder\""),
            Self::Version { found } => {
                write!(f, "the recording has format {found}, this program reads {VERSION}: record it again")
            }
            Self::CutShort => write!(f, "the recording is cut short: it ends within its head or a step"),
            Self::Head { part } => write!(f, "the recording's head makes no sense: {part}"),
            Self::Body { found } => {
                write!(f, "the recording names body {found}, which the scene does not have")
            }
            Self::TooMany { found } => write!(f, "a step lists {found} bodies, more than the scene has"),
            Self::Pose { body } => {
                write!(
                    f,
                    "the pose of body {body} is none: a number is not finite, or too large, or of no rotation"
                )
            }
        }
    }
}

impl std::error::Error for RecordError {}

impl From<std::io::Error> for RecordError {
    fn from(error: std::io::Error) -> Self {
        if error.kind() == ErrorKind::UnexpectedEof { Self::CutShort } else { Self::Io(error) }
    }
}

/// Writes the head of a recording.
///
/// # Errors
/// Those of the file system; a name that is too long.
pub fn write_head(to: &mut impl Write, head: &Head) -> Result<(), RecordError> {
    let name = head.name.as_bytes();
    let length = u32::try_from(name.len()).unwrap_or(u32::MAX);
    if length > MAX_NAME {
        return Err(RecordError::Head { part: "its name is too long" });
    }
    to.write_all(&MAGIC)?;
    to.write_all(&VERSION.to_le_bytes())?;
    to.write_all(&head.dimension.to_le_bytes())?;
    to.write_all(&head.size.to_le_bytes())?;
    to.write_all(&head.bodies.to_le_bytes())?;
    to.write_all(&length.to_le_bytes())?;
    Ok(to.write_all(name)?)
}

/// Writes a step.
///
/// # Errors
/// Those of the file system.
pub fn write_step<S: Playable>(to: &mut impl Write, step: &Step<S>) -> Result<(), RecordError> {
    to.write_all(&(step.moved.len() as u32).to_le_bytes())?;
    for (body, pose) in &step.moved {
        to.write_all(&body.to_le_bytes())?;
        write_pose::<S>(pose, to)?;
    }
    to.write_all(&(step.left.len() as u32).to_le_bytes())?;
    for number in step.left.iter().chain([&step.contacts, &step.overlapping]) {
        to.write_all(&number.to_le_bytes())?;
    }
    Ok(())
}

fn write_pose<S: Playable>(pose: &S::Pose, to: &mut impl Write) -> Result<(), std::io::Error> {
    let [of_position, _] = S::Pose::COUNTS;
    pose.numbers().enumerate().try_for_each(|(place, number)| match place < of_position {
        true => to.write_all(&number.to_le_bytes()),
        false => to.write_all(&(number as f32).to_le_bytes()),
    })
}

fn read_pose<S: Playable>(from: &mut impl Read) -> Result<Option<S::Pose>, std::io::Error> {
    let [of_position, of_rotation] = S::Pose::COUNTS;
    let mut numbers = Vec::with_capacity(of_position + of_rotation);
    for _ in 0..of_position {
        numbers.push(f64::from_le_bytes(read(from)?));
    }
    for _ in 0..of_rotation {
        numbers.push(f64::from(f32::from_le_bytes(read(from)?)));
    }
    Ok(S::Pose::of_numbers(&numbers))
}

/// Reads the head of a recording.
///
/// # Errors
/// A file that is no recording, is of another version, or is cut short; a dimension other than 2 and 3; a name that is
/// too long or not UTF-8.
pub fn read_head(from: &mut impl Read) -> Result<Head, RecordError> {
    let magic: [u8; 8] = read(from)?;
    if magic != MAGIC {
        return Err(RecordError::NoRecording);
    }
    let version = read_u32(from)?;
    if version != VERSION {
        return Err(RecordError::Version { found: version });
    }
    let dimension = read_u32(from)?;
    if !(2..=3).contains(&dimension) {
        return Err(RecordError::Head { part: "its dimension is neither 2 nor 3" });
    }
    let size = u64::from_le_bytes(read(from)?);
    let bodies = read_u32(from)?;
    let length = read_u32(from)?;
    if length > MAX_NAME {
        return Err(RecordError::Head { part: "its name is too long" });
    }
    let mut name = vec![0; length as usize];
    from.read_exact(&mut name)?;
    let name = String::from_utf8(name).map_err(|_| RecordError::Head { part: "its name is no text" })?;
    Ok(Head { dimension, size, bodies, name })
}

/// Reads a step; `None` at the end of the recording. Memory grows only with what is actually read, whatever counts the
/// file claims.
///
/// # Errors
/// A step that is cut short; bodies that the scene does not have; poses that are not valid.
pub fn read_step<S: Playable>(from: &mut impl Read, head: &Head) -> Result<Option<Step<S>>, RecordError> {
    let mut first = [0; 1];
    loop {
        match from.read(&mut first) {
            Ok(0) => return Ok(None),
            Ok(_) => break,
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(error) => return Err(error.into()),
        }
    }
    let [second, third, fourth] = read(from)?;
    let count = check_count(u32::from_le_bytes([first[0], second, third, fourth]), head)?;
    let mut moved = Vec::new();
    for _ in 0..count {
        let body = read_body(from, head)?;
        let pose = read_pose::<S>(from)?.ok_or(RecordError::Pose { body })?;
        moved.push((body, pose));
    }
    let count = check_count(read_u32(from)?, head)?;
    let left = (0..count).map(|_| read_body(from, head)).collect::<Result<_, _>>()?;
    Ok(Some(Step { moved, left, contacts: read_u32(from)?, overlapping: read_u32(from)? }))
}

fn check_count(found: u32, head: &Head) -> Result<u32, RecordError> {
    if found <= head.bodies { Ok(found) } else { Err(RecordError::TooMany { found }) }
}

fn read_body(from: &mut impl Read, head: &Head) -> Result<u32, RecordError> {
    let found = read_u32(from)?;
    if found < head.bodies { Ok(found) } else { Err(RecordError::Body { found }) }
}

fn read_u32(from: &mut impl Read) -> Result<u32, RecordError> {
    Ok(u32::from_le_bytes(read(from)?))
}

/// Reads `N` bytes.
fn read<const N: usize>(from: &mut impl Read) -> Result<[u8; N], std::io::Error> {
    let mut bytes = [0; N];
    from.read_exact(&mut bytes)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use asunder::{Plane, Pose2};

    fn sample() -> (Head, Vec<u8>) {
        let head = Head { dimension: 2, size: 5, bodies: 6, name: "letters".to_owned() };
        let step = Step::<Plane> {
            moved: vec![(1, Pose2::IDENTITY), (5, Pose2::at([-2.0, 0.25]).unwrap())],
            left: vec![3],
            contacts: 9,
            overlapping: 8,
        };
        let mut bytes = Vec::new();
        write_head(&mut bytes, &head).unwrap();
        write_step(&mut bytes, &step).unwrap();
        (head, bytes)
    }

    fn play(mut bytes: &[u8]) -> Result<usize, RecordError> {
        let head = read_head(&mut bytes)?;
        let mut steps = 0;
        while read_step::<Plane>(&mut bytes, &head)?.is_some() {
            steps += 1;
        }
        Ok(steps)
    }

    /// Half a percent of all rotations change when they are normalised once more.
    #[test]
    fn poses_come_back_in_every_bit() {
        let head = Head { dimension: 2, size: 1, bodies: 1, name: "letters".to_owned() };
        let mut are_others = 0;
        for i in 0..4000 {
            let rotation = Rotation2::new(libm::cos(f64::from(i)) as f32, -0.7).unwrap();
            are_others += u32::from(Rotation2::new(rotation.cos(), rotation.sin()).unwrap() != rotation);
            let pose = Pose2::new([0.1, 1e9], rotation).unwrap();
            let step = Step::<Plane> { moved: vec![(0, pose)], left: vec![], contacts: 0, overlapping: 0 };
            let mut bytes = Vec::new();
            write_step(&mut bytes, &step).unwrap();
            assert_eq!(read_step(&mut &bytes[..], &head).unwrap(), Some(step), "{rotation:?}");
        }
        assert!(are_others > 0);
    }

    #[test]
    fn a_recording_cut_anywhere_is_refused_or_shorter() {
        let (head, bytes) = sample();
        let head_length = 32 + head.name.len();
        for length in 0..bytes.len() {
            match play(&bytes[..length]) {
                Ok(steps) => assert!(length == head_length && steps == 0, "cut at {length}"),
                Err(error) => assert!(matches!(error, RecordError::CutShort), "cut at {length}: {error}"),
            }
        }
        assert!(matches!(play(&bytes), Ok(1)));
    }

    #[test]
    fn a_recording_with_any_byte_changed_never_panics() {
        let (_, bytes) = sample();
        for at in 0..bytes.len() {
            for value in [0, 1, 0x7f, 0x80, 0xff] {
                let mut other = bytes.clone();
                other[at] = value;
                // Whatever the byte is, the result is a recording or an error with a message.
                let told = play(&other).map_or_else(|error| error.to_string().len(), |_| 1);
                assert!(told > 0);
            }
        }
    }

    #[test]
    fn faults_of_a_recording_are_told_apart() {
        let (head, bytes) = sample();
        let changed = |at: usize, value: &[u8]| {
            let mut other = bytes.clone();
            other[at..at + value.len()].copy_from_slice(value);
            play(&other).unwrap_err()
        };
        let step = 32 + head.name.len();
        assert!(matches!(changed(0, b"A"), RecordError::NoRecording));
        assert!(matches!(changed(8, &[2]), RecordError::Version { found: 2 }));
        assert!(matches!(changed(12, &[4]), RecordError::Head { .. }));
        assert!(matches!(changed(step, &[7]), RecordError::TooMany { found: 7 }));
        assert!(matches!(changed(step + 4, &[6]), RecordError::Body { found: 6 }));
        let nan = f64::NAN.to_le_bytes();
        assert!(matches!(changed(step + 8, &nan), RecordError::Pose { body: 1 }));
    }
}
