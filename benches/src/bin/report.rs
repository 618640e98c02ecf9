//! Makes the page of speed against error: measures, stores the rows as CSV, draws the page.

use asunder_benches::report::cpu::Processor;
use asunder_benches::report::measure::measure;
use asunder_benches::report::sections::chapters;
use asunder_benches::report::{Data, Section, markdown, page, readme};
use asunder_tests::counting::Counting;
use clap::Parser;
use indicatif::{ProgressBar, ProgressStyle};
use std::error::Error;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

// Rows of frames include how often memory is allocated, and how much.
#[global_allocator]
static COUNTING: Counting = Counting;

/// Speed against error, in one page: target/report/index.html, and report.md beside its pictures.
#[derive(Parser)]
#[command(name = "report")]
struct Options {
    /// Two minutes in place of eight: smaller sets, no million; a look, no figures to quote.
    #[arg(long)]
    quick: bool,
    /// The folder of the page.
    #[arg(long, value_name = "DIR", default_value = "target/report")]
    out: PathBuf,
    /// Keep what is measured in `benches/results/<cpu>`, as CSV; sections not measured stay as they are.
    #[arg(long)]
    save: bool,
    /// Draw from such a folder, and measure nothing.
    #[arg(long, value_name = "DIR", conflicts_with_all = ["quick", "save", "cpu"])]
    from: Option<PathBuf>,
    /// Only this section: error, gap, stability, broad, frame or vertices; may be given more than once.
    #[arg(long, value_name = "SECTION", value_parser = section)]
    only: Vec<Section>,
    /// The processor's name, where the system's says too little.
    #[arg(long, value_name = "NAME")]
    cpu: Option<String>,
    /// Put plots and table into README, from the saved data: with --save or --from.
    #[arg(long)]
    readme: bool,
}

fn section(name: &str) -> Result<Section, String> {
    let names: Vec<&str> = Section::ALL.iter().map(|section| section.name()).collect();
    Section::by_name(name).ok_or_else(|| format!("one of {}", names.join(", ")))
}

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options::parse();
    if options.readme && !options.save && options.from.is_none() {
        return Err("README shows saved data: give --readme together with --save or --from".into());
    }
    let (data, folder) = match &options.from {
        Some(folder) => (kept_in(folder)?, Some(folder.clone())),
        None => measured(&options)?,
    };
    write_page(&data, &options)?;
    if let (true, Some(folder)) = (options.readme, folder) {
        write_readme(&folder)?;
    }
    Ok(())
}

/// The rows of a folder, which must have some.
fn kept_in(folder: &Path) -> Result<Data, Box<dyn Error>> {
    let data = Data::read(folder)?;
    if data == Data::default() {
        return Err(format!("no rows in {}", folder.display()).into());
    }
    Ok(data)
}

/// The repository's root, where results and README are, wherever the program is started.
fn root() -> &'static Path {
    let benches = Path::new(env!("CARGO_MANIFEST_DIR"));
    benches.parent().unwrap_or(benches)
}

/// Measures, and stores the data if asked to; also returns the folder where it is stored.
fn measured(options: &Options) -> Result<(Data, Option<PathBuf>), Box<dyn Error>> {
    let mut processor = Processor::here();
    if let Some(name) = &options.cpu {
        processor.name.clone_from(name);
    }
    let folder = root().join("benches/results").join(processor.folder());
    let mut data = if options.save { Data::read(&folder)? } else { Data::default() };
    let sections: Vec<Section> = Section::ALL
        .into_iter()
        .filter(|section| options.only.is_empty() || options.only.contains(section))
        .collect();
    let bar = ProgressBar::new(100 * sections.len() as u64);
    let style = "[{elapsed_precise}] {bar:30} {percent:>3} % {msg}";
    bar.set_style(ProgressStyle::with_template(style)?);
    for (i, &section) in sections.iter().enumerate() {
        let start = 100 * i as u64;
        bar.set_position(start);
        // A step that cannot tell how much is left moves the bar by one at each new text.
        let said = Mutex::new(String::new());
        let progress = |text: &str, part: Option<f64>| {
            if let Some(part) = part {
                bar.set_position(start + (100.0 * part) as u64);
            } else if bar.position() < start + 99 && said.lock().is_ok_and(|said| *said != text) {
                bar.inc(1);
            }
            if let Ok(mut said) = said.lock() {
                *said = text.to_string();
            }
            bar.set_message(format!("{}: {text}", section.name()));
        };
        measure(&mut data, section, (options.quick, &processor), &progress)?;
        if options.save {
            data.write(&folder)?;
        }
    }
    bar.finish_and_clear();
    if options.save {
        println!("data: {}", folder.strip_prefix(root()).unwrap_or(&folder).display());
    }
    Ok((data, options.save.then_some(folder)))
}

fn write_page(data: &Data, options: &Options) -> Result<(), Box<dyn Error>> {
    let mut chapters = chapters(data);
    chapters.retain(|chapter| options.only.is_empty() || options.only.contains(&chapter.section));
    std::fs::create_dir_all(&options.out)?;
    std::fs::write(options.out.join("index.html"), page::to_html(&chapters))?;
    std::fs::write(options.out.join("report.md"), markdown::to_markdown(&chapters))?;
    for figure in chapters.iter().flat_map(|chapter| &chapter.figures) {
        std::fs::write(options.out.join(&figure.file).with_extension("svg"), &figure.svg)?;
    }
    println!("page: {}", options.out.join("index.html").display());
    Ok(())
}

fn write_readme(folder: &Path) -> Result<(), Box<dyn Error>> {
    // Read back from the files, as later runs will read it.
    let data = Data::read(folder)?;
    let (path, folder) = (root().join("README.md"), std::path::absolute(folder)?);
    let named = folder.strip_prefix(root()).map_err(|_| "README shows data of this repository alone")?;
    let named = named.display().to_string();
    let page = std::fs::read_to_string(&path)?;
    let new = readme::spliced(&page, &named, &readme::part(&data));
    std::fs::write(&path, new.ok_or("README.md has no two marks, figures:begin and figures:end")?)?;
    let pictures = root().join(readme::FOLDER);
    std::fs::create_dir_all(&pictures)?;
    for figure in readme::figures(&data) {
        std::fs::write(pictures.join(&figure.file).with_extension("svg"), &figure.svg)?;
    }
    println!("README.md and {}: drawn", readme::FOLDER);
    Ok(())
}
