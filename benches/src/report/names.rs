//! Short forms of figures, for plots and tables.

/// A time, to two or three digits.
///
/// ```
/// use asunder_benches::report::names::duration;
/// assert_eq!([7.04, 61.4, 1540.0, 2.5e7].map(duration), ["7.0 ns", "61 ns", "1.5 µs", "25 ms"]);
/// assert_eq!(duration(f64::NAN), "-");
/// ```
pub fn duration(ns: f64) -> String {
    let (value, unit) = match ns {
        _ if !ns.is_finite() => return "-".to_string(),
        _ if ns < 999.5 => (ns, "ns"),
        _ if ns < 999.5e3 => (ns * 1e-3, "µs"),
        _ if ns < 999.5e6 => (ns * 1e-6, "ms"),
        _ => (ns * 1e-9, "s"),
    };
    format!("{} {unit}", short(value))
}

/// A time that is a round number, for an axis.
///
/// ```
/// use asunder_benches::report::names::round;
/// assert_eq!([1.0, 1e3, 1e5].map(round), ["1 ns", "1 µs", "100 µs"]);
/// ```
pub fn round(ns: f64) -> String {
    duration(ns).replace(".0 ", " ")
}

/// A number to two digits, or more before the point.
///
/// ```
/// use asunder_benches::report::names::short;
/// assert_eq!([0.123, 9.94, 9.96, 1234.5].map(short), ["0.12", "9.9", "10", "1234"]);
/// ```
pub fn short(value: f64) -> String {
    match value.abs() {
        size if size < 0.995 => format!("{value:.2}"),
        size if size < 9.95 => format!("{value:.1}"),
        _ => format!("{value:.0}"),
    }
}

/// An error: one digit and a power of ten.
///
/// ```
/// use asunder_benches::report::names::error;
/// assert_eq!([0.0, 3.4e-8, 1.2].map(error), ["0", "3e-8", "1e0"]);
/// ```
pub fn error(value: f64) -> String {
    if value == 0.0 {
        return "0".to_string();
    }
    if value.is_finite() { format!("{value:.0e}") } else { "no number".to_string() }
}

/// Any number in short: plain where that is short, else as [`error`].
///
/// ```
/// use asunder_benches::report::names::number;
/// assert_eq!([0.0, 0.5, 31.0, 2e6, 1e-5].map(number), ["0", "0.50", "31", "2e6", "1e-5"]);
/// ```
pub fn number(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_string(),
        size if (0.01..1e5).contains(&size) => short(value),
        _ => error(value),
    }
}

/// A whole number in groups of three digits.
///
/// ```
/// use asunder_benches::report::names::count;
/// assert_eq!([0, 999, 1000, 1_082_192].map(count), ["0", "999", "1,000", "1,082,192"]);
/// ```
pub fn count(value: u64) -> String {
    let digits = value.to_string();
    let mut grouped = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            grouped.push(',');
        }
        grouped.push(digit);
    }
    grouped
}

/// A power of ten as a label on an axis of counts.
///
/// ```
/// use asunder_benches::report::names::size;
/// assert_eq!([10, 1000, 100_000, 1_000_000].map(size), ["10", "1k", "100k", "1M"]);
/// ```
pub fn size(value: u64) -> String {
    match value {
        1_000_000.. => format!("{}M", value / 1_000_000),
        1000.. => format!("{}k", value / 1000),
        _ => value.to_string(),
    }
}

/// The name of a family of pairs, in words.
///
/// ```
/// assert_eq!(asunder_benches::report::names::words("near-touching"), "near touching");
/// ```
pub fn words(name: &str) -> String {
    name.replace(['-', '_'], " ")
}

/// A dimension as in prose: `3D`.
pub fn dimension(name: &str) -> String {
    name.to_uppercase()
}
