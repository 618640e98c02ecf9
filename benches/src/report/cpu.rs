//! The processor's name, as text and as a folder name.

/// The processor that this program runs on.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Processor {
    /// Its name, as in `AMD EPYC (Zen 4)`.
    pub name: String,
    /// Whether the system runs in a virtual machine.
    pub is_virtual: bool,
}

impl Processor {
    /// As reported by the system: on Linux from `/proc/cpuinfo`, elsewhere only the architecture.
    pub fn here() -> Self {
        let said = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        Self::from_cpuinfo(&said)
    }

    /// Reads the first processor of `/proc/cpuinfo`.
    ///
    /// ```
    /// use asunder_benches::report::cpu::Processor;
    /// let said = "vendor_id\t: AuthenticAMD\ncpu family\t: 25\nmodel\t\t: 17\nmodel name\t: AMD EPYC\nflags\t\t: fpu hypervisor";
    /// let processor = Processor::from_cpuinfo(said);
    /// assert_eq!((processor.name.as_str(), processor.is_virtual), ("AMD EPYC (Zen 4)", true));
    /// assert_eq!(processor.folder(), "amd-epyc-zen-4");
    /// ```
    pub fn from_cpuinfo(said: &str) -> Self {
        let of = |key: &str| {
            let lines = said.lines().filter_map(|line| line.split_once(':'));
            lines.into_iter().find(|(name, _)| name.trim() == key).map_or("", |(_, value)| value.trim())
        };
        let number = |key: &str| of(key).parse::<u32>().unwrap_or(0);
        let mut name = plain(of("model name"));
        if name.is_empty() {
            name = std::env::consts::ARCH.to_string();
        }
        // A virtual machine may hide the model number; family and model identify the generation.
        if let (false, Some(zen)) =
            (name.contains(|c: char| c.is_ascii_digit()), zen(number("cpu family"), number("model")))
        {
            name = format!("{name} ({zen})");
        }
        Self { name, is_virtual: of("flags").split_whitespace().any(|flag| flag == "hypervisor") }
    }

    /// Its name as a folder name.
    ///
    /// ```
    /// use asunder_benches::report::cpu::Processor;
    /// let said = "model name : Intel(R) Core(TM) i7-8650U CPU @ 1.90GHz";
    /// assert_eq!(Processor::from_cpuinfo(said).folder(), "intel-core-i7-8650u");
    /// ```
    pub fn folder(&self) -> String {
        let letters = self.name.to_lowercase();
        let words = letters.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
        words.collect::<Vec<_>>().join("-")
    }
}

/// A model's name without trademarks, clock rate and words without meaning.
fn plain(name: &str) -> String {
    let name = name.replace("(R)", "").replace("(TM)", "").replace("(tm)", "");
    let name = name.split('@').next().unwrap_or("");
    let is_said = |word: &&str| !["CPU", "Processor"].contains(word) && !word.ends_with("-Core");
    name.split_whitespace().filter(is_said).collect::<Vec<_>>().join(" ")
}

/// AMD's generations, by family and model.
const fn zen(family: u32, model: u32) -> Option<&'static str> {
    match (family, model) {
        (23, 0..=0x2f) => Some("Zen"),
        (23, _) => Some("Zen 2"),
        (25, 0x10..=0x1f | 0x60..=0x7f | 0xa0..=0xaf) => Some("Zen 4"),
        (25, _) => Some("Zen 3"),
        (26, _) => Some("Zen 5"),
        _ => None,
    }
}
