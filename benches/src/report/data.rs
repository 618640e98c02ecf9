//! Measured data, as plain rows in CSV files of one folder: all that the page is drawn from.

use super::kept::KeptRow;
use super::origin::Origin;
use crate::broad::rows::BroadRow;
use crate::error::{ErrorRow, GapRow, StabilityRow, VertexRow};
use crate::world::rows::FrameRow;
use serde::{Serialize, de::DeserializeOwned};
use std::error::Error;
use std::path::Path;

/// A section of the page, and a file of the data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Section {
    /// The time of every method against its error.
    Error,
    /// Wrong answers by the size of the gap.
    Gap,
    /// How stable answers are.
    Stability,
    /// All overlapping pairs of boxes.
    Broad,
    /// Whole frames.
    Frame,
    /// Time against vertices.
    Vertices,
}

impl Section {
    /// Every section, in the order of the page.
    pub const ALL: [Self; 6] =
        [Self::Error, Self::Gap, Self::Stability, Self::Broad, Self::Frame, Self::Vertices];

    /// Its name, also used for its file, anchor and option.
    ///
    /// ```
    /// use asunder_benches::report::Section;
    /// assert_eq!(Section::by_name(Section::Gap.name()), Some(Section::Gap));
    /// ```
    pub const fn name(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Gap => "gap",
            Self::Stability => "stability",
            Self::Broad => "broad",
            Self::Frame => "frame",
            Self::Vertices => "vertices",
        }
    }

    /// The section of a name.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|section| section.name() == name)
    }
}

/// All rows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Data {
    /// The origin of each section.
    pub origins: Vec<Origin>,
    /// Time and error.
    pub error: Vec<ErrorRow>,
    /// Wrong answers by gap.
    pub gap: Vec<GapRow>,
    /// Stability.
    pub stability: Vec<StabilityRow>,
    /// Broad phase.
    pub broad: Vec<BroadRow>,
    /// Frames.
    pub frame: Vec<FrameRow>,
    /// Vertices.
    pub vertices: Vec<VertexRow>,
    /// Rows of `compare`, which are in no section of the page, but in README.
    pub kept: Vec<KeptRow>,
}

/// The file with the origin of each section.
const ORIGINS: &str = "origin";
/// The file with the rows that `compare` saved.
const KEPT: &str = "compare";

impl Data {
    /// Reads a folder. Files that do not exist give no rows.
    ///
    /// # Errors
    /// A file that cannot be read, or is not such a table.
    pub fn read(folder: &Path) -> Result<Self, Box<dyn Error>> {
        Ok(Self {
            origins: read(folder, ORIGINS)?,
            error: read(folder, Section::Error.name())?,
            gap: read(folder, Section::Gap.name())?,
            stability: read(folder, Section::Stability.name())?,
            broad: read(folder, Section::Broad.name())?,
            frame: read(folder, Section::Frame.name())?,
            vertices: read(folder, Section::Vertices.name())?,
            kept: read(folder, KEPT)?,
        })
    }

    /// Writes all tables that have rows into a folder, which is made if needed. Other files stay as they are.
    ///
    /// # Errors
    /// The folder or a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), Box<dyn Error>> {
        std::fs::create_dir_all(folder)?;
        write(folder, Section::Error.name(), &self.error)?;
        write(folder, Section::Gap.name(), &self.gap)?;
        write(folder, Section::Stability.name(), &self.stability)?;
        write(folder, Section::Broad.name(), &self.broad)?;
        write(folder, Section::Frame.name(), &self.frame)?;
        write(folder, Section::Vertices.name(), &self.vertices)?;
        write(folder, KEPT, &self.kept)?;
        write(folder, ORIGINS, &self.origins)
    }

    /// The origin of a section.
    pub fn origin(&self, section: Section) -> Option<&Origin> {
        self.origins.iter().find(|origin| origin.section == section.name())
    }

    /// Sets the origin of a section, in place of an older one.
    pub fn set_origin(&mut self, origin: Origin) {
        self.origins.retain(|known| known.section != origin.section);
        self.origins.push(origin);
        let rank = |origin: &Origin| Section::ALL.iter().position(|section| section.name() == origin.section);
        self.origins.sort_by_key(rank);
    }
}

fn read<T: DeserializeOwned>(folder: &Path, name: &str) -> Result<Vec<T>, Box<dyn Error>> {
    let path = folder.join(name).with_extension("csv");
    if !path.exists() {
        return Ok(Vec::new());
    }
    let rows: Result<Vec<T>, csv::Error> = csv::Reader::from_path(&path)?.into_deserialize().collect();
    rows.map_err(|error| format!("{}: {error}", path.display()).into())
}

fn write<T: Serialize>(folder: &Path, name: &str, rows: &[T]) -> Result<(), Box<dyn Error>> {
    if rows.is_empty() {
        return Ok(());
    }
    let mut writer = csv::Writer::from_path(folder.join(name).with_extension("csv"))?;
    rows.iter().try_for_each(|row| writer.serialize(row))?;
    Ok(writer.flush()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A temporary folder, which is deleted when dropped.
    struct Folder(std::path::PathBuf);

    impl Folder {
        fn new(name: &str) -> Self {
            let path = std::env::temp_dir().join(format!("asunder-{name}-{}", std::process::id()));
            let _ = std::fs::remove_dir_all(&path);
            Self(path)
        }
    }

    impl Drop for Folder {
        fn drop(&mut self) {
            let _ = std::fs::remove_dir_all(&self.0);
        }
    }

    fn some_data() -> Data {
        let broad = BroadRow {
            scene: "gas, \"dense\"".to_string(),
            ns: 0.1 + 0.2,
            ns_high: f64::MAX,
            ns_low: 5e-324,
            pairs: u64::MAX,
            ..BroadRow::default()
        };
        let frame = FrameRow { scene: "two\nlines".to_string(), allocations: -1.0, ..FrameRow::default() };
        let gap = GapRow {
            dimension: "3d".to_string(),
            group: "far".to_string(),
            method: "fast".to_string(),
            decade: -99,
            apart: false,
            pairs: 3,
            wrong: 1,
        };
        let error = ErrorRow {
            dimension: "2d".to_string(),
            group: "slivers".to_string(),
            method: "textbook-f32".to_string(),
            pairs: 10,
            answered: 10,
            ns: 1.5,
            ns_low: 1.0,
            ns_high: 2.0,
            error_p99: 0.0,
            error_max: f64::INFINITY,
            wrong_per_100k: 1e5,
            refused: 0,
        };
        let origin = Origin { section: "gap".to_string(), ..Origin::default() };
        Data {
            origins: vec![origin],
            error: vec![error],
            gap: vec![gap],
            broad: vec![broad],
            frame: vec![frame],
            ..Data::default()
        }
    }

    #[test]
    fn what_is_written_comes_back_in_every_bit() {
        let folder = Folder::new("round-trip");
        let data = some_data();
        data.write(&folder.0).unwrap();
        assert_eq!(Data::read(&folder.0).unwrap(), data);
        assert!(!folder.0.join("vertices.csv").exists(), "nothing was measured of it");
    }

    #[test]
    fn a_damaged_file_is_refused_by_name() {
        let folder = Folder::new("damaged");
        some_data().write(&folder.0).unwrap();
        std::fs::write(folder.0.join("gap.csv"), "dimension,group\n3d,far\n").unwrap();
        let error = Data::read(&folder.0).unwrap_err().to_string();
        assert!(error.contains("gap.csv"), "{error}");
    }

    #[test]
    fn a_section_has_one_origin_and_they_stand_in_order() {
        let mut data = Data::default();
        for (section, date) in [("frame", "1"), ("error", "2"), ("frame", "3")] {
            let (section, date) = (section.to_string(), date.to_string());
            data.set_origin(Origin { section, date, ..Origin::default() });
        }
        let dates: Vec<&str> = data.origins.iter().map(|origin| origin.date.as_str()).collect();
        assert_eq!(dates, ["2", "3"]);
    }
}
