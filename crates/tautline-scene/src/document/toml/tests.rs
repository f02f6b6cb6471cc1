//! Against the library `toml`, which reads with trees.

use ::toml::Value as Toml;
use proptest::prelude::*;
use serde_json::Value as Json;

use super::super::{Format, limits, parse};
use super::*;

fn json(text: &str) -> String {
    to_json(text).expect(text)
}

/// Line, column and message.
fn refused(text: &str) -> (usize, usize, String) {
    let refusal = to_json(text).expect_err(text);
    let before = &text[..refusal.offset];
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1, refusal.message)
}

#[test]
fn what_is_written_keeps_the_order_of_the_text() {
    let text = "z = 1\nb.y = 'é\"\\'\n[c]\nd = [1, {e = +2.50, f.g = true, f.h = []},]\n[[a]]\n[[a]]\nx = -0\n[a.b]\n";
    let expected = concat!(
        r#"{"z":1,"b":{"y":"é\"\\"},"c":{"d":[1,{"e":2.50,"f":{"g":true,"h":[]}}]},"#,
        r#""a":[{},{"x":0,"b":{}}]}"#
    );
    assert_eq!(json(text), expected);
    assert_eq!(json(""), "{}");
}

#[test]
fn every_number_and_string_keeps_its_value() {
    for (toml, expected) in [
        ("0xff_FF", "65535"),
        ("0o17", "15"),
        ("0b101", "5"),
        ("+1_000", "1000"),
        ("-9223372036854775808", "-9223372036854775808"),
        ("1_0.5_0e+0_3", "10.50e+03"),
        ("-0.0", "-0.0"),
        ("5E-324", "5E-324"),
        ("'''\n\\\n'''", r#""\\\n""#),
        ("\"\"\"\na\\\n   b\tc\"\"\"", r#""ab\u0009c""#),
        (r#""\x41\u00e9\U0001F600\e""#, r#""Aé😀\u001b""#),
    ] {
        assert_eq!(json(&format!("a = {toml}")), format!("{{\"a\":{expected}}}"));
    }
}

#[test]
fn refusals_say_where_and_what() {
    let deep = |open: &str| format!("a = {}", open.repeat(limits::NESTING));
    let many = (0..=500).fold(String::new(), |text, i| text + &format!("k{i} = 0\n"));
    for (text, line, column, message) in [
        ("a = 1\nb", 2, 2, "expected `=`, and a value"),
        ("a = 1\n= 2", 2, 1, "expected a key"),
        ("[a.]", 1, 4, "expected a key"),
        ("[a\n]", 1, 3, "expected `]`"),
        ("[[a] ]", 1, 5, "expected `]`"),
        ("a =\n1", 1, 4, "expected a value"),
        ("a = 1 b = 2", 1, 7, "expected the end of the line"),
        ("'é' = [1 2]", 1, 10, "expected `,` or the end of the brackets"),
        ("a = {b = 1 c = 2}", 1, 12, "expected `,` or the end of the brackets"),
        ("a = [,]", 1, 6, "expected a value"),
        ("a = [1,\n[2,\n", 2, 1, "this bracket is not closed"),
        ("a = {", 1, 5, "this bracket is not closed"),
        ("a = 1\n\na = 2", 3, 1, "there is something of this name already"),
        ("[a]\n[a]", 2, 2, "there is something of this name already"),
        ("a = {b = 1, b = 2}", 1, 13, "there is something of this name already"),
        ("a = []\n[[a]]", 2, 3, "there is something of this name already"),
        ("[a]\n[[a]]", 2, 3, "there is something of this name already"),
        ("a.b = 1\n[a]", 2, 2, "there is something of this name already"),
        ("a = {}\n[a.b]", 2, 2, "it is a value: a header adds nothing to it"),
        ("a = {}\na.b = 1", 2, 1, "it is there already: a dotted key adds nothing to it"),
        ("[a.b]\n[a]\nb.c = 1", 3, 1, "it is there already: a dotted key adds nothing to it"),
        ("[[a.b]]\n[a]\nb.c.d = 1", 3, 1, "it is a list of tables: a dotted key adds nothing to it"),
        ("a = {b = {}, b.c = 1}", 1, 14, "it is there already: a dotted key adds nothing to it"),
        ("a = -inf", 1, 5, "-inf is not a finite number"),
        ("a = nan", 1, 5, "nan is not a finite number"),
        ("a = [\n1979-05-27T07:32:00Z]", 2, 1, "a scene has no dates and times: put text in quotes"),
        (
            "a = 9223372036854775808",
            1,
            5,
            "9223372036854775808 is no integer of 64 bits: write it with a decimal point",
        ),
        ("a = heavy", 1, 5, "string values must be quoted, expected literal string"),
        ("a = 'b", 1, 7, "invalid literal string, expected `'`"),
        ("# \u{1}", 1, 3, "invalid comment character, expected printable characters"),
        ("a = 1\r", 1, 7, "carriage return must be followed by newline, expected `\n`"),
        (&deep("["), 1, 68, "it nests more than 64 levels deep"),
        (&deep("{a="), 1, 99, "it nests more than 64 levels deep"),
        (&"a.".repeat(1000), 1, 129, "it nests more than 64 levels deep"),
        (&many, 501, 1, "there are more than 500 keys in tables that are not complete"),
    ] {
        assert_eq!(refused(text), (line, column, message.to_owned()), "{text}");
    }
}

#[test]
fn keys_of_complete_tables_are_not_counted() {
    let text = "[[a]]\nb = {c = 1, d.e = 2}\nf.g = [{h = 3}]\n[a.i]\nj = 4\n".repeat(1000);
    assert_eq!(json(&text).matches("\"j\":4").count(), 1000);
}

#[test]
fn values_are_found_by_their_paths() {
    let text = "name = 'x'\n[[bodies]]\nrope = {}\n[[bodies]]\n[bodies.rigid]\nposition = [1, # [\n 2]\nshape.box.size = [3]\n\
                [[bodies.rigid.parts]]\n[[bodies.rigid.parts]]\nshape = { ball = { radius = 4 } }\n[[bodies]]\n'cloth' = {}\n";
    for (path, expected) in [
        ("", "name ="),
        ("name", "'x'"),
        ("bodies", "bodies]]\nrope"),
        ("bodies[0].rope", "{}\n[[bodies]]\n[bodies.rigid]"),
        ("bodies[1]", "bodies]]\n[bodies.rigid]"),
        ("bodies[1].rigid.position[1]", "2]"),
        ("bodies[1].rigid.position[2]", "[1, #"),
        ("bodies[1].rigid.mass", "rigid]\nposition"),
        ("bodies[1].rigid.shape", "shape.box"),
        ("bodies[1].rigid.shape.box.size[0]", "3]"),
        ("bodies[1].rigid.parts[1].shape.ball.radius", "4 }"),
        ("bodies[2].cloth.mass", "{}\n"),
        ("bodies[7].rigid", "bodies]]\nrope"),
        ("seconds", "name ="),
    ] {
        let found = &text[offset_of(text, path)..];
        assert!(found.starts_with(expected), "{path}: {found}");
    }
    assert_eq!(offset_of("a = [1, 2", "a[5]"), 4);
}

#[test]
fn wrong_values_are_refused_where_they_are_in_toml() {
    for (text, expected) in [
        (
            "tautline = 1\nseconds = 'long'",
            "line 2, column 11: seconds: invalid type: string \"long\", expected f32",
        ),
        ("tautline = 1\nseconds = 1e400", "line 2, column 11: seconds: number out of range"),
        (
            "tautline = 1\nbodies = [{ rope = {} },\n { cloth = { mass.kg = 1 } }]",
            "line 3, column 14: bodies[1].cloth.mass: invalid type: map, expected f32",
        ),
        (
            "tautline = 1\n[[bodies]]\nrope = {}\n[[bodies]]\n  [bodies.rope]\n  colour = 1 # it is",
            "line 6, column 12: bodies[1].rope.colour: unknown field `colour`",
        ),
        (
            "tautline = 1\n[[bodies]]\n[[bodies.rope.pins]]",
            "line 3, column 15: bodies[0].rope.pins[0]: invalid type: map, expected the index of a particle",
        ),
        ("[camera]\nfov = 1", "line 1, column 1: missing field `tautline`"),
        ("tautline = 1\n[bounds]\nmin = [0, 0, 0]", "line 2, column 2: bounds: missing field `max`"),
        ("tautline = 1\nseconds = nan", "line 2, column 11: nan is not a finite number"),
        ("tautline = 1\nname = 'a\nb'", "line 2, column 10: invalid literal string, expected `'`"),
    ] {
        let error = parse(text, Format::Toml).unwrap_err().to_string();
        assert!(error.starts_with(expected), "{text}: {error}");
    }
}

/// Whether there is something in it that JSON has no words for.
fn is_beyond_json(value: &Toml) -> bool {
    match value {
        Toml::Datetime(_) => true,
        Toml::Float(number) => !number.is_finite(),
        Toml::Array(items) => items.iter().any(is_beyond_json),
        Toml::Table(members) => members.values().any(is_beyond_json),
        Toml::String(_) | Toml::Integer(_) | Toml::Boolean(_) => false,
    }
}

fn is_same(toml: &Toml, json: &Json) -> bool {
    match (toml, json) {
        (Toml::String(a), Json::String(b)) => a == b,
        (Toml::Integer(a), Json::Number(b)) => b.as_i64() == Some(*a),
        // The last bit of a number of 64 bits is not always read right from JSON: a scene has numbers of 32.
        (Toml::Float(a), Json::Number(b)) => {
            b.as_f64().is_some_and(|b| (a - b).abs() <= f64::EPSILON * a.abs() && a.signum() == b.signum())
        }
        (Toml::Boolean(a), Json::Bool(b)) => a == b,
        (Toml::Array(a), Json::Array(b)) => a.len() == b.len() && a.iter().zip(b).all(|(a, b)| is_same(a, b)),
        (Toml::Table(a), Json::Object(b)) => {
            a.len() == b.len() && a.iter().all(|(key, a)| b.get(key).is_some_and(|b| is_same(a, b)))
        }
        _ => false,
    }
}

/// Whether it is read, or refused, as `toml` does.
fn agrees(text: &str) -> Result<(), TestCaseError> {
    let expected = ::toml::from_str::<Toml>(text);
    let read = to_json(text).map_err(|refusal| refusal.message);
    let outcome =
        read.clone().and_then(|json| serde_json::from_str(&json).map_err(|error| error.to_string()));
    let agree = match (&expected, &outcome) {
        (Ok(toml), Ok(json)) => is_same(toml, json),
        (Ok(toml), Err(message)) => is_beyond_json(toml) || message.contains("it is a list of tables"),
        (Err(_), outcome) => outcome.is_err(),
    };
    prop_assert!(agree, "{text:?}: {expected:?}, {outcome:?}");
    Ok(())
}

/// One of the first, or now and then one of the others.
fn mostly(
    often: &[&'static str],
    rarely: &[&'static str],
) -> impl Strategy<Value = &'static str> + Clone + use<> {
    prop_oneof![30 => prop::sample::select(often.to_vec()), 1 => prop::sample::select(rarely.to_vec())]
}

fn scalar() -> impl Strategy<Value = String> {
    let sound = [
        "0",
        "-0",
        "+7",
        "1_000",
        "0xdead_BEEF",
        "0o755",
        "0b1_0",
        "-9223372036854775808",
        "1.5",
        "-0.0",
        "+1e5",
        "6.02_2e-2_3",
        "true",
        "false",
        "''",
        r"'\x'",
        "\"\"",
        r#""\t\u00e9\"""#,
        "'''\n'a''''",
        "\"\"\"\\\n  \"b\"\\\\\"\"\"",
    ];
    let odd = [
        "9223372036854775808",
        "01",
        "1__0",
        "0x_1",
        "1e999",
        "1.",
        ".5",
        "1e",
        "inf",
        "-nan",
        "True",
        r#""\x4""#,
        r#""\q""#,
        "1979-05-27",
        "1979-05-27 07:32:00",
        "07:32",
        "x",
        "",
        "1 2",
    ];
    mostly(&sound, &odd).prop_map(str::to_owned)
}

fn value() -> impl Strategy<Value = String> {
    let gap = || mostly(&["", "", " ", "\n", "# c\n", "\t"], &["\r\n", "\r", "#\u{1}\n"]);
    let end = || mostly(&["", ","], &[",,", "="]);
    scalar().prop_recursive(4, 16, 4, move |inner| {
        let item = (gap(), inner.clone(), gap()).prop_map(|(a, item, b)| format!("{a}{item}{b}"));
        let pair = (gap(), path(), gap(), inner, gap())
            .prop_map(|(a, path, b, item, c)| format!("{a}{path}{b}={b}{item}{c}"));
        let list = (prop::collection::vec(item, 0..4), end())
            .prop_map(|(items, end)| format!("[{}{end}]", items.join(",")));
        let table = (prop::collection::vec(pair, 0..4), end())
            .prop_map(|(items, end)| format!("{{{}{end}}}", items.join(",")));
        prop_oneof![list, table]
    })
}

fn path() -> impl Strategy<Value = String> {
    let key =
        mostly(&["a", "b", "c", "d", "e", "\"a\"", "'b'", r#""\u0063""#, "''", "1"], &["é", "", "'''a'''"]);
    let dot = prop::sample::select(vec![".", " . ", ". "]);
    (key.clone(), prop::collection::vec((dot, key), 0..3))
        .prop_map(|(first, rest)| rest.iter().fold(first.to_owned(), |path, (dot, key)| path + dot + key))
}

fn document() -> impl Strategy<Value = String> {
    let statement = prop_oneof![
        4 => (path(), value()).prop_map(|(path, value)| format!("{path} = {value}")),
        2 => path().prop_map(|path| format!("[{path}]")),
        2 => path().prop_map(|path| format!("[[ {path} ]]")),
        1 => mostly(&["", " # c", "\t"], &["[", "a", "a = 1 2", "#\u{1}", "\r"]).prop_map(str::to_owned),
    ];
    prop::collection::vec((statement, prop::sample::select(vec!["\n", "\n", "\r\n", " # c\n"])), 0..8)
        .prop_map(|lines| lines.into_iter().fold(String::new(), |text, (line, end)| text + &line + end))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn documents_are_read_as_the_library_toml_reads_them(text in document()) {
        agrees(&text)?;
    }

    #[test]
    fn any_text_is_read_as_the_library_toml_reads_it(text in "[\\[\\]{}=.,'\"\\\\# \n\r\tabeinfxu0-9_:+-]{0,40}") {
        agrees(&text)?;
    }

    #[test]
    fn a_document_with_a_change_is_read_as_the_library_toml_reads_it(
        text in document(), at in 0.0..1.0, length in 0usize..3, new in "[\\[\\]{}=.,'\"\\\\# \na0\u{7f}]{0,2}",
    ) {
        let mut chars: Vec<char> = text.chars().collect();
        let start = (at * chars.len() as f64) as usize;
        let end = (start + length).min(chars.len());
        chars.splice(start..end, new.chars());
        agrees(&chars.into_iter().collect::<String>())?;
    }
}
