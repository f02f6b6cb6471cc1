//! What the project's text must not say: the architecture, as absences. ARCHITECTURE.md gives the reasons.

use crate::files::{TextFile, library_code, text_files};
use crate::project::Project;
use crate::steps::Outcome;

/// Words that library code of some folders must not contain.
struct Absence {
    folders: &'static [&'static str],
    words: &'static [&'static str],
    reason: &'static str,
    /// Files where they may stand.
    except: &'static [&'static str],
}

const ENGINE: &[&str] = &["crates/tautline/src/"];
const LIBRARIES: &[&str] = &["crates/tautline/src/", "crates/tautline-scene/src/"];

const ABSENCES: &[Absence] = &[
    Absence {
        folders: &["crates/tautline/src/geometry/", "crates/tautline/src/mesh/"],
        words: &[
            "World",
            "crate::world",
            "crate::body",
            "crate::collision",
            "crate::solver",
            "crate::settings",
        ],
        reason: "geometry and meshes know no world",
        except: &[],
    },
    Absence {
        folders: &["crates/tautline/src/collision/"],
        words: &["&mut Particles", "ParticlesMut", "&mut World", "slice_mut(", ".shift("],
        reason: "collision moves nothing",
        except: &[],
    },
    Absence {
        folders: ENGINE,
        words: &["std::time", "std::fs", "std::env", "std::io", "std::net", "std::process"],
        reason: "the engine has no clock and no files of its own",
        except: &[],
    },
    Absence {
        folders: ENGINE,
        words: &["std::thread"],
        reason: "the engine has no threads of its own",
        // It has those of the pool step aside.
        except: &["crates/tautline/src/parallel/team.rs"],
    },
    Absence {
        folders: ENGINE,
        words: &["HashMap", "HashSet", "RandomState"],
        reason: "their order differs from run to run: a sorted Vec or a BTreeMap does not",
        // Only looked up, never gone through.
        except: &[
            "crates/tautline/src/mesh/tetrahedra/advance.rs",
            "crates/tautline/src/mesh/tetrahedra/conforming.rs",
            "crates/tautline/src/mesh/tetrahedra/delaunay.rs",
        ],
    },
    Absence {
        folders: LIBRARIES,
        words: &[".unwrap()", "panic!(", "todo!(", "unimplemented!(", "unreachable!(", "process::exit"],
        reason: "libraries return errors (clippy finds what these words miss)",
        except: &[],
    },
    Absence {
        folders: LIBRARIES,
        words: &["println!(", "print!(", "eprintln!(", "eprint!(", "dbg!("],
        reason: "libraries print nothing",
        except: &[],
    },
];

/// Functions of floating-point numbers that platforms, or compilers, round as they like.
const INEXACT: &[&str] = &[
    "sin", "cos", "tan", "sin_cos", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "exp", "exp2",
    "ln", "log", "log2", "log10", "powf", "powi", "cbrt", "hypot", "mul_add",
];

/// Files that may contain unsafe code.
const UNSAFE_FILES: &[&str] = &[
    "bindings/python/src/views.rs",
    "crates/tautline/src/parallel/team.rs",
    "crates/tautline/src/simd/avx2.rs",
];

const MOST_LINES: usize = 800;

/// Folders of one machine.
const MACHINE_PATHS: &[&str] = &["/home/", "/root/", "/tmp/", "/work/", "/Users/", "C:\\"];

/// Addresses that name a format, a licence or this machine itself, and where public projects are.
const HOSTS: &[&str] =
    &["json-schema.org", "www.w3.org", "www.apache.org", "github.com", "localhost", "127.0.0.1"];

/// Every rule on every text file; the failure lists every breach.
pub(crate) fn tidy(project: &Project) -> Result<Outcome, String> {
    let files = text_files(&project.root)?;
    let mut breaches = Vec::new();
    for file in &files {
        check_rust(file, &mut breaches);
        // This file spells out what it looks for.
        if file.path != file!().replace('\\', "/") {
            check_text(file, &mut breaches);
        }
        check_links(project, file, &mut breaches);
    }
    if breaches.is_empty() {
        return Ok(Outcome::Noted(format!("{} files", files.len())));
    }
    Err(format!("{} breaches\n{}", breaches.len(), breaches.join("\n")))
}

fn check_rust(file: &TextFile, breaches: &mut Vec<String>) {
    if !file.path.ends_with(".rs") {
        return;
    }
    let lines = file.text.lines().count();
    if lines > MOST_LINES {
        breaches.push(format!("{}: {lines} lines; split it by subject", file.path));
    }
    let mut breach = |line: usize, what: &str, reason: &str| {
        breaches.push(format!("{}:{line}: {what}: {reason}", file.path));
    };
    // A folder of unit tests is test code as a whole.
    let library = if file.path.contains("/src/") && file.path.contains("/tests/") { "" } else { &file.text };
    for absence in ABSENCES {
        if !is_under(file, absence.folders) || absence.except.contains(&file.path.as_str()) {
            continue;
        }
        for (number, line) in library_code(library) {
            for word in absence.words.iter().filter(|word| contains_word(line, word)) {
                breach(number, word, absence.reason);
            }
        }
    }
    if is_under(file, ENGINE) {
        for (number, line) in library_code(library) {
            for name in INEXACT.iter().filter(|name| calls_method(line, name)) {
                breach(number, name, "not the same bits everywhere; use the libm crate, or multiply out");
            }
        }
    }
    if is_under(file, &["crates/tautline/src/collision/"]) {
        for (number, line) in library_code(library).filter(|(_, line)| assigns_particles(line)) {
            breach(number, line.trim(), "collision moves nothing");
        }
    }
    if !UNSAFE_FILES.contains(&file.path.as_str()) {
        for number in unsafe_lines(file) {
            breach(number, "unsafe", "none outside the files listed in xtask/src/tidy.rs");
        }
    }
}

/// Lines of a Rust file with unsafe code, or with leave for it.
pub(crate) fn unsafe_lines(file: &TextFile) -> Vec<usize> {
    if !file.path.ends_with(".rs") || file.path.starts_with("xtask/") {
        return Vec::new();
    }
    let code = file.text.lines().map(|line| line.split("//").next().unwrap_or(line)).enumerate();
    let found = code.filter(|(_, line)| contains_word(line, "unsafe") || line.contains("allow(unsafe_code"));
    found.map(|(index, _)| index + 1).collect()
}

fn check_text(file: &TextFile, breaches: &mut Vec<String>) {
    for (index, line) in file.text.lines().enumerate() {
        for path in MACHINE_PATHS.iter().filter(|path| contains_word(line, path)) {
            breaches.push(format!("{}:{}: {path}: a path of one machine", file.path, index + 1));
        }
        for host in hosts(line).filter(|host| !HOSTS.contains(host)) {
            breaches.push(format!("{}:{}: {host}: a host that is not on the list", file.path, index + 1));
        }
    }
}

/// Links from Markdown files to files of the project.
fn check_links(project: &Project, file: &TextFile, breaches: &mut Vec<String>) {
    if !file.path.ends_with(".md") {
        return;
    }
    let folder = project.root.join(&file.path);
    let folder = folder.parent().unwrap_or(&project.root);
    for (index, line) in file.text.lines().enumerate() {
        let targets = line.split("](").skip(1).filter_map(|rest| rest.split([')', '#']).next());
        for target in targets.filter(|target| !target.is_empty() && !target.contains("://")) {
            if !folder.join(target).exists() {
                breaches.push(format!("{}:{}: {target}: the link leads nowhere", file.path, index + 1));
            }
        }
    }
}

fn is_under(file: &TextFile, folders: &[&str]) -> bool {
    folders.iter().any(|folder| file.path.starts_with(folder))
}

/// Whether `word` stands in `line`, and not as a part of a longer word.
fn contains_word(line: &str, word: &str) -> bool {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    line.match_indices(word).any(|(start, _)| {
        let before = line[..start].chars().next_back();
        let after = line[start + word.len()..].chars().next();
        let open_at_start = word.starts_with(|c| !is_part(c) && c != '/') || !before.is_some_and(is_part);
        let open_at_end = word.ends_with(|c| !is_part(c)) || !after.is_some_and(is_part);
        open_at_start && open_at_end
    })
}

/// `.sin(` and `f32::sin`, but not `.sin_cos(` or `libm::sinf`.
fn calls_method(line: &str, name: &str) -> bool {
    line.contains(&format!(".{name}("))
        || contains_word(line, &format!("f32::{name}"))
        || contains_word(line, &format!("f64::{name}"))
}

/// `.position[i] = …`, `.displacement[i] += …` and the like, as rustfmt writes them.
fn assigns_particles(line: &str) -> bool {
    let after = [".position[", ".displacement["].iter().filter_map(|field| line.split_once(field));
    after
        .into_iter()
        .any(|(_, rest)| ["] = ", "] += ", "] -= ", "] *= "].iter().any(|end| rest.contains(end)))
}

fn hosts(line: &str) -> impl Iterator<Item = &str> {
    let is_host = |c: char| c.is_alphanumeric() || matches!(c, '.' | '-');
    line.split("://").skip(1).map(move |rest| rest.split(|c| !is_host(c)).next().unwrap_or(rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn breaches(path: &str, text: &str) -> Vec<String> {
        let file = TextFile { path: path.into(), text: text.into() };
        let mut breaches = Vec::new();
        check_rust(&file, &mut breaches);
        check_text(&file, &mut breaches);
        breaches
    }

    #[test]
    fn every_absence_is_noticed_and_comments_and_tests_are_spared() {
        for absence in ABSENCES {
            for word in absence.words {
                let path = format!("{}subject.rs", absence.folders[0]);
                assert_eq!(breaches(&path, &format!("let a = 1;\n  {word}\n")).len(), 1, "{word}");
                assert!(breaches(&path, &format!("// {word}\n#[cfg(test)]\nmod t {{ {word} }}")).is_empty());
            }
        }
        assert_eq!(breaches("crates/tautline/src/step.rs", "x.sin() + f32::cos(y)\n").len(), 2);
        assert_eq!(breaches("crates/tautline-cli/src/main.rs", "unsafe { x }\n").len(), 1);
        assert_eq!(breaches("crates/a.rs", &"\n".repeat(801)).len(), 1);
    }

    #[test]
    fn longer_words_are_other_words() {
        assert!(contains_word("fn f(world: &World)", "World"));
        assert!(!contains_word("WorldView, a world", "World"));
        assert!(!contains_word("eprintln!()", "println!("));
        assert!(contains_word("see /tmp/a", "/tmp/") && !contains_word("a/frame/tmp/b", "/tmp/"));
        assert!(calls_method("a.sin()", "sin") && !calls_method("libm::sinf(a).min(b)", "sin"));
    }

    #[test]
    fn assignment_is_told_from_reading() {
        assert!(assigns_particles("store.position[i] += shift;"));
        assert!(assigns_particles("store.displacement[a[0]] = shift;"));
        assert!(!assigns_particles("if store.position[i] == x {"));
        assert!(!assigns_particles("let x = store.position[i];"));
    }

    #[test]
    fn hosts_and_paths_of_one_machine_are_breaches() {
        assert_eq!(breaches("a.md", "see http://10.0.0.1/x and https://www.w3.org/y\n").len(), 1);
        assert_eq!(breaches("a.toml", "path = \"/home/me/x\"\n").len(), 1);
    }
}
