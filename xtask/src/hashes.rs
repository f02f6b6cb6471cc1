//! The same scene gives the same bits: without optimisation and with it, on one thread and on two.

use crate::command::{cargo, output, program, run};
use crate::project::Project;
use crate::steps::Outcome;

/// Rigid bodies, cloth, rope and bending.
const SCENES: &[&str] = &["icosahedra", "hammock"];

pub(crate) fn hashes(project: &Project) -> Result<Outcome, String> {
    let mut noted = Vec::new();
    for (folder, build) in [
        ("debug", &["build", "--locked", "-p", "tautline-cli"][..]),
        ("release", &["build", "--locked", "-p", "tautline-cli", "--release"]),
    ] {
        run(&mut cargo(project, build))?;
        for scene in SCENES {
            for threads in ["1", "2"] {
                let arguments = ["run", scene, "--seconds", "1", "--json", "--threads", threads];
                let json = output(&mut program(project, project.tautline(folder), &arguments))?;
                let hash = text_field(&json, "state_hash").ok_or("the summary has no state_hash")?;
                println!("{scene}, {folder}, {threads} thread(s): {hash}");
                noted.push((*scene, hash.to_owned()));
            }
        }
    }
    noted.sort();
    noted.dedup();
    if noted.len() > SCENES.len() {
        return Err(format!("the hashes differ: {noted:?}"));
    }
    Ok(Outcome::Noted(format!("{} scenes, the same bits four times each", SCENES.len())))
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
