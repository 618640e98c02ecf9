//! Writes the files of the examples, and makes the folders they go to.

use std::error::Error;
use std::fs::{self, File};
use std::io::Write;
use std::path::Path;

/// Creates a file, in place of an older one.
///
/// ```
/// use asunder_examples::output::create;
/// let folder = std::env::temp_dir().join(format!("asunder-output-{}", std::process::id()));
/// create(&folder.join("new").join("file"))?;
/// assert!(folder.join("new").join("file").is_file());
/// std::fs::remove_dir_all(folder)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Those of the file system, with the path.
pub fn create(file: &Path) -> Result<File, Box<dyn Error>> {
    if let Some(folder) = file.parent() {
        fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    }
    Ok(File::create(file).map_err(|error| format!("{}: {error}", file.display()))?)
}

/// Writes a whole file.
///
/// ```
/// use asunder_examples::output::write;
/// let refused = write(&std::env::temp_dir(), "a folder is no file");
/// assert!(refused.is_err_and(|error| error.to_string().starts_with(&*std::env::temp_dir().to_string_lossy())));
/// ```
///
/// # Errors
/// Those of the file system, with the path.
pub fn write(file: &Path, text: &str) -> Result<(), Box<dyn Error>> {
    let written = create(file)?.write_all(text.as_bytes());
    Ok(written.map_err(|error| format!("{}: {error}", file.display()))?)
}
