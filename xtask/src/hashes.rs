//! The same scene gives the same bits: without optimisation and with it, on one thread and on two.

use crate::command::{cargo, output, program, run};
use crate::project::Project;
use crate::steps::Outcome;

const RUN: &[&str] = &["run", "icosahedra", "--set", "n=10", "--seconds", "2", "--json", "--threads"];

pub(crate) fn hashes(project: &Project) -> Result<Outcome, String> {
    let mut found: Vec<(String, String)> = Vec::new();
    for (folder, build) in [
        ("debug", &["build", "--locked", "-p", "tautline-cli"][..]),
        ("release", &["build", "--locked", "-p", "tautline-cli", "--release"]),
    ] {
        run(&mut cargo(project, build))?;
        for threads in ["1", "2"] {
            let arguments = [RUN, &[threads]].concat();
            let json = output(&mut program(project, project.tautline(folder), &arguments))?;
            let hash = text_field(&json, "state_hash").ok_or("the summary has no state_hash")?;
            println!("{hash}");
            found.push((format!("{folder} with {threads} thread(s): {hash}"), hash.to_owned()));
        }
    }
    if found.iter().all(|(_, hash)| *hash == found[0].1) {
        return Ok(Outcome::Noted(format!("state_hash {} four times", found[0].1)));
    }
    let lines: Vec<String> = found.into_iter().map(|(line, _)| line).collect();
    Err(format!("the hashes differ\n{}", lines.join("\n")))
}

/// The text of a field of a JSON object, if it has no escapes.
fn text_field<'a>(json: &'a str, name: &str) -> Option<&'a str> {
    let (_, rest) = json.split_once(&format!("\"{name}\""))?;
    let value = rest.trim_start().strip_prefix(':')?.trim_start().strip_prefix('"')?;
    value.split('"').next().filter(|text| !text.is_empty())
}

#[cfg(test)]
mod tests {
    use super::text_field;

    #[test]
    fn a_text_field_is_found_whatever_the_spacing() {
        assert_eq!(text_field("{\"a\":1,\n \"state_hash\" : \"00ff\" }", "state_hash"), Some("00ff"));
        assert_eq!(text_field("{\"state_hash\":\"00ff\"}", "state_hash"), Some("00ff"));
        assert_eq!(text_field("{\"state_hash\":12}", "state_hash"), None);
        assert_eq!(text_field("{\"other\":\"00ff\"}", "state_hash"), None);
    }
}
