//! Statements and values, token by token.

use std::borrow::Cow;
use std::fmt::Write;
use std::iter::Peekable;

use toml_parser::decoder::ScalarKind;
use toml_parser::lexer::{Lexer, TokenKind};
use toml_parser::{Expected, ParseError, Raw, Source, Span};

use super::super::limits;
use super::table::{Key, OpenKeys, Path, Table, write_string};
use super::trail::Trail;
use super::{Outcome, Refusal};

/// What may be between two tokens.
#[derive(Clone, Copy)]
enum Gap {
    Space,
    /// Also the ends of lines, and comments.
    Lines,
}

pub(super) struct Reader<'a> {
    text: &'a str,
    tokens: Peekable<Lexer<'a>>,
    open: OpenKeys,
}

impl<'a> Reader<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self { text, tokens: Source::new(text).lex().peekable(), open: OpenKeys::default() }
    }

    /// Reads all of the text.
    pub(super) fn document(mut self, trail: Trail) -> Outcome<String> {
        let mut root = Table::new();
        self.statements(&mut root, 0, trail)?;
        while self.take(TokenKind::LeftSquareBracket) {
            let is_of_list = self.take(TokenKind::LeftSquareBracket);
            let path = self.path(0)?;
            let depth = path.outer.len() + 1;
            for _ in 0..1 + usize::from(is_of_list) {
                self.expect(TokenKind::RightSquareBracket, "expected `]`")?;
            }
            self.end_line()?;
            let (table, trail) = root.begin(path, is_of_list, trail, &mut self.open)?;
            self.statements(table, depth, trail)?;
        }
        let mut json = String::new();
        root.write(&mut json, &mut self.open);
        Ok(json)
    }

    /// Reads lines up to a header or the end.
    fn statements(&mut self, table: &mut Table<'a>, depth: usize, trail: Trail) -> Outcome {
        loop {
            self.skip(Gap::Lines)?;
            match self.kind() {
                TokenKind::LeftSquareBracket | TokenKind::Eof => return Ok(()),
                _ => self.pair(table, Gap::Space, depth, trail)?,
            }
            self.end_line()?;
        }
    }

    /// Reads `path = value`.
    fn pair(&mut self, table: &mut Table<'a>, gap: Gap, depth: usize, trail: Trail) -> Outcome {
        let path = self.path(depth)?;
        let depth = depth + path.outer.len() + 1;
        self.skip(gap)?;
        self.expect(TokenKind::Equals, "expected `=`, and a value")?;
        self.skip(gap)?;
        let (place, trail) = table.place(path, self.offset(), trail, &mut self.open)?;
        let mut json = String::new();
        self.value(&mut json, depth, trail)?;
        place.put(json);
        Ok(())
    }

    /// Reads keys with dots between them.
    fn path(&mut self, depth: usize) -> Outcome<Path<'a>> {
        let mut outer = Vec::new();
        loop {
            self.skip(Gap::Space)?;
            refuse_deep(depth + outer.len(), self.offset())?;
            let key = self.key()?;
            self.skip(Gap::Space)?;
            if !self.take(TokenKind::Dot) {
                return Ok(Path { outer, last: key });
            }
            outer.push(key);
        }
    }

    fn key(&mut self) -> Outcome<Key<'a>> {
        let offset = self.offset();
        if self.kind() != TokenKind::Atom && !is_string(self.kind()) {
            return Err(Refusal::new(offset, "expected a key"));
        }
        let raw = self.next();
        let mut name = Cow::Borrowed("");
        sound(|errors| raw.decode_key(&mut name, errors))?;
        Ok(Key { name, offset })
    }

    /// Writes a value as JSON.
    fn value(&mut self, json: &mut String, depth: usize, trail: Trail) -> Outcome {
        match self.kind() {
            TokenKind::LeftSquareBracket => {
                json.push('[');
                self.items(TokenKind::RightSquareBracket, depth, |reader, index| {
                    if index > 0 {
                        json.push(',');
                    }
                    let trail = trail.item(index, reader.offset());
                    reader.value(json, depth + 1, trail)
                })?;
                json.push(']');
            }
            TokenKind::LeftCurlyBracket => {
                let mut table = Table::new();
                self.items(TokenKind::RightCurlyBracket, depth, |reader, _| {
                    reader.pair(&mut table, Gap::Lines, depth + 1, trail)
                })?;
                table.write(json, &mut self.open);
            }
            _ => self.scalar(json)?,
        }
        Ok(())
    }

    /// Reads what is between brackets, with commas between the items and perhaps after the last.
    fn items(
        &mut self,
        close: TokenKind,
        depth: usize,
        mut read: impl FnMut(&mut Self, usize) -> Outcome,
    ) -> Outcome {
        let bracket = self.offset();
        refuse_deep(depth, bracket)?;
        self.tokens.next();
        for index in 0.. {
            self.skip(Gap::Lines)?;
            if self.take(close) {
                break;
            }
            self.refuse_unclosed(bracket)?;
            read(self, index)?;
            self.skip(Gap::Lines)?;
            if self.take(close) {
                break;
            }
            self.refuse_unclosed(bracket)?;
            self.expect(TokenKind::Comma, "expected `,` or the end of the brackets")?;
        }
        Ok(())
    }

    /// Writes a string, number or truth value as JSON.
    fn scalar(&mut self, json: &mut String) -> Outcome {
        let offset = self.offset();
        let raw = match self.kind() {
            kind if is_string(kind) => self.next(),
            TokenKind::Atom | TokenKind::Dot => self.word(),
            _ => return Err(Refusal::new(offset, "expected a value")),
        };
        let mut decoded = Cow::Borrowed("");
        match sound(|errors| raw.decode_scalar(&mut decoded, errors))? {
            ScalarKind::String => write_string(&decoded, json),
            ScalarKind::Boolean(_) => json.push_str(&decoded),
            ScalarKind::Float if decoded.ends_with(|c: char| c.is_ascii_digit()) => {
                json.push_str(decoded.trim_start_matches('+'));
            }
            ScalarKind::Float => {
                return Err(Refusal::new(offset, format!("{} is not a finite number", raw.as_str())));
            }
            ScalarKind::Integer(radix) => match i64::from_str_radix(&decoded, radix.value()) {
                Ok(integer) => _ = write!(json, "{integer}"),
                Err(_) => {
                    let message =
                        format!("{} is no integer of 64 bits: write it with a decimal point", raw.as_str());
                    return Err(Refusal::new(offset, message));
                }
            },
            ScalarKind::DateTime => {
                return Err(Refusal::new(offset, "a scene has no dates and times: put text in quotes"));
            }
        }
        Ok(())
    }

    /// Moves past a word or number, in which there may be dots.
    fn word(&mut self) -> Raw<'a> {
        let mut span = self.span();
        while let TokenKind::Atom | TokenKind::Dot = self.kind() {
            span = span.append(self.span());
            self.tokens.next();
        }
        self.raw(TokenKind::Atom, span)
    }

    /// Moves to the end of the line, before which there may be a comment.
    fn end_line(&mut self) -> Outcome {
        self.skip(Gap::Space)?;
        match self.kind() {
            TokenKind::Comment | TokenKind::Newline | TokenKind::Eof => Ok(()),
            _ => Err(Refusal::new(self.offset(), "expected the end of the line")),
        }
    }

    fn skip(&mut self, gap: Gap) -> Outcome {
        loop {
            match (self.kind(), gap) {
                (TokenKind::Whitespace, _) => _ = self.tokens.next(),
                (TokenKind::Comment, Gap::Lines) => {
                    let raw = self.next();
                    sound(|errors| raw.decode_comment(errors))?;
                }
                (TokenKind::Newline, Gap::Lines) => {
                    let raw = self.next();
                    sound(|errors| raw.decode_newline(errors))?;
                }
                _ => return Ok(()),
            }
        }
    }

    /// The kind of the next token.
    fn kind(&mut self) -> TokenKind {
        self.tokens.peek().map_or(TokenKind::Eof, |token| token.kind())
    }

    /// Where the next token is.
    fn span(&mut self) -> Span {
        let end = self.text.len();
        self.tokens.peek().map_or(Span::new_unchecked(end, end), |token| token.span())
    }

    fn offset(&mut self) -> usize {
        self.span().start()
    }

    /// Moves past the next token, and returns its text.
    fn next(&mut self) -> Raw<'a> {
        let (kind, span) = (self.kind(), self.span());
        self.tokens.next();
        self.raw(kind, span)
    }

    /// Text for its decoder.
    fn raw(&self, kind: TokenKind, span: Span) -> Raw<'a> {
        let text = self.text.get(span.start()..span.end()).unwrap_or_default();
        Raw::new_unchecked(text, kind.encoding(), span)
    }

    /// Moves past a token if it is of this kind.
    fn take(&mut self, kind: TokenKind) -> bool {
        self.tokens.next_if(|token| token.kind() == kind).is_some()
    }

    fn expect(&mut self, kind: TokenKind, or_else: &str) -> Outcome {
        if self.take(kind) { Ok(()) } else { Err(Refusal::new(self.offset(), or_else)) }
    }

    fn refuse_unclosed(&mut self, bracket: usize) -> Outcome {
        if self.kind() == TokenKind::Eof {
            return Err(Refusal::new(bracket, "this bracket is not closed"));
        }
        Ok(())
    }
}

fn refuse_deep(depth: usize, offset: usize) -> Outcome {
    if depth < limits::NESTING {
        return Ok(());
    }
    Err(Refusal::new(offset, format!("it nests more than {} levels deep", limits::NESTING)))
}

fn is_string(kind: TokenKind) -> bool {
    use TokenKind::{BasicString, LiteralString, MlBasicString, MlLiteralString};
    matches!(kind, BasicString | LiteralString | MlBasicString | MlLiteralString)
}

/// What has been decoded, or the first thing that is wrong with it.
fn sound<T>(decode: impl FnOnce(&mut Option<ParseError>) -> T) -> Outcome<T> {
    let mut error = None;
    let decoded = decode(&mut error);
    error.map_or(Ok(decoded), |error| Err(refusal(&error)))
}

fn refusal(error: &ParseError) -> Refusal {
    let mut message = error.description().to_owned();
    for (i, expected) in error.expected().unwrap_or_default().iter().enumerate() {
        message.push_str(if i == 0 { ", expected " } else { ", " });
        match expected {
            Expected::Literal(text) => _ = write!(message, "`{text}`"),
            Expected::Description(text) => message.push_str(text),
            _ => {}
        }
    }
    let span = error.unexpected().or(error.context());
    Refusal::new(span.map_or(0, |span| span.start()), message)
}
