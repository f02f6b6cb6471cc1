//! The results for people.

use tautline_scene::validate::{Figures, Outcome, Part};

use crate::output;

const HEADER: [&str; 6] = ["case", "measured", "expected", "error", "demand", ""];

/// A row for each case, by group, with the part that does worst; below it all parts (`in_full`) or those that fail, and
/// then what there is to know about the case. A last line counts.
pub(super) fn table(outcomes: &[Outcome], in_full: bool) -> String {
    let mut groups: Vec<&str> = Vec::new();
    for outcome in outcomes {
        if !groups.contains(&outcome.group) {
            groups.push(outcome.group);
        }
    }
    let (mut rows, mut headings, mut notes) = (Vec::new(), Vec::new(), Vec::new());
    for group in groups {
        headings.push((rows.len(), group));
        for outcome in outcomes.iter().filter(|outcome| outcome.group == group) {
            rows.push(summary(outcome));
            let told = outcome.parts.iter().filter(|part| in_full || !part.pass);
            rows.extend(told.map(part_row));
            if in_full || !outcome.pass {
                notes.push((rows.len(), outcome.note));
            }
        }
    }
    let lines = output::table(&HEADER, &rows);
    let mut text = String::new();
    for (index, line) in lines.lines().enumerate() {
        // The first line is the header.
        if let Some((_, group)) = headings.iter().find(|(row, _)| row + 1 == index) {
            text += &format!("\n{group}\n");
        }
        text += &format!("{line}\n");
        if let Some((_, note)) = notes.iter().find(|(row, _)| *row == index) {
            text += &paragraph(note);
        }
    }
    let passed = outcomes.iter().filter(|outcome| outcome.pass).count();
    text + &format!("\n{passed} of {} cases pass\n", outcomes.len())
}

/// Indented lines of at most so many characters; none if there is no text.
fn paragraph(text: &str) -> String {
    const INDENT: &str = "        ";
    const LONGEST: usize = 100;
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= LONGEST => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(format!("{INDENT}{word}")),
        }
    }
    lines.into_iter().map(|line| line + "\n").collect()
}

fn summary(outcome: &Outcome) -> Vec<String> {
    row(format!("{:>4}  {}", outcome.id, outcome.name), &outcome.figures, outcome.pass)
}

fn part_row(part: &Part) -> Vec<String> {
    row(format!("      · {}", part.name), &part.figures, part.pass)
}

fn row(name: String, figures: &Figures, pass: bool) -> Vec<String> {
    vec![
        name,
        quantity(figures.measured, figures.unit),
        quantity(figures.expected, figures.unit),
        quantity(figures.error, figures.error_unit),
        quantity(figures.demand, figures.error_unit),
        verdict(pass),
    ]
}

fn verdict(pass: bool) -> String {
    if pass { "pass" } else { "FAIL" }.to_owned()
}

/// Five digits and the unit.
fn quantity(value: f64, unit: &str) -> String {
    let number = number(value);
    if unit.is_empty() { number } else { format!("{number} {unit}") }
}

/// Plain where that takes few zeros, else with a power of ten.
fn number(value: f64) -> String {
    let size = value.abs();
    let text = match size {
        0.0 => return "0".to_owned(),
        1e-3..1e6 => {
            let before_point = if size < 1.0 { 1 } else { size.log10() as usize + 1 };
            format!("{value:.*}", 6usize.saturating_sub(before_point))
        }
        _ => format!("{value:.1e}"),
    };
    let plain = text.contains('.') && !text.contains('e');
    if plain { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn notes_are_broken_between_words() {
        assert_eq!(paragraph(""), "");
        let text = "a word ".repeat(40);
        let lines = paragraph(&text);
        assert!(
            lines.lines().count() > 2 && lines.lines().all(|line| line.chars().count() <= 100),
            "{lines}"
        );
        assert_eq!(lines.split_whitespace().count(), 80);
    }

    #[test]
    fn numbers_are_short() {
        let cases = [
            (0.0, "0"),
            (3.204109, "3.20411"),
            (-4.62, "-4.62"),
            (980.38, "980.38"),
            (0.25, "0.25"),
            (1.54e-5, "1.5e-5"),
            (6.7e7, "6.7e7"),
            (f64::NAN, "NaN"),
        ];
        for (value, text) in cases {
            assert_eq!(number(value), text);
        }
    }
}
