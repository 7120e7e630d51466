//! The words of a scene file.

use super::place::Spot;
use crate::Result;
use crate::import::text::shown;
use std::path::Path;
use std::rc::Rc;

/// What a token is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum TokenKind {
    /// A directive, a number, `true` or `false`.
    Word,
    /// In quotes, which are not part of the text.
    Quoted,
    /// `[`.
    Open,
    /// `]`.
    Close,
}

/// A word and its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Token<'t> {
    pub kind: TokenKind,
    pub text: &'t str,
    line: u32,
    column: u32,
}

impl Token<'_> {
    /// The token for a message.
    pub fn shown(&self) -> String {
        match self.kind {
            TokenKind::Quoted => format!("\"{}\"", shown(self.text)),
            _ => format!("`{}`", shown(self.text)),
        }
    }
}

/// Cuts a text into tokens. Comments go from `#` to the end of their line.
pub(super) struct Lexer<'t> {
    pub file: Rc<Path>,
    text: &'t str,
    /// Byte of the next character, and its place.
    at: usize,
    line: u32,
    column: u32,
    peeked: Option<Token<'t>>,
}

impl<'t> Lexer<'t> {
    pub fn new(file: Rc<Path>, text: &'t str) -> Self {
        Self { file, text, at: 0, line: 1, column: 1, peeked: None }
    }

    /// Where a token is.
    pub fn spot(&self, token: &Token<'_>) -> Spot {
        Spot { file: self.file.clone(), line: token.line, column: token.column }
    }

    /// Where the text ends, once all of it has been read.
    pub fn end(&self) -> Spot {
        Spot { file: self.file.clone(), line: self.line, column: self.column }
    }

    /// The next token, which stays.
    pub fn peek(&mut self) -> Result<Option<Token<'t>>> {
        if self.peeked.is_none() {
            self.peeked = self.read()?;
        }
        Ok(self.peeked)
    }

    /// The next token; none at the end.
    pub fn next(&mut self) -> Result<Option<Token<'t>>> {
        match self.peeked.take() {
            Some(token) => Ok(Some(token)),
            None => self.read(),
        }
    }

    fn read(&mut self) -> Result<Option<Token<'t>>> {
        self.skip();
        let (start, line, column) = (self.at, self.line, self.column);
        let token = |kind, text| Some(Token { kind, text, line, column });
        let Some(first) = self.byte() else { return Ok(None) };
        self.advance();
        match first {
            b'[' => Ok(token(TokenKind::Open, "[")),
            b']' => Ok(token(TokenKind::Close, "]")),
            b'"' => {
                self.quoted(Spot { file: self.file.clone(), line, column })?;
                Ok(token(TokenKind::Quoted, self.text.get(start + 1..self.at - 1).unwrap_or("")))
            }
            _ => {
                while self.byte().is_some_and(|byte| !b"\"[]# \t\r\n".contains(&byte)) {
                    self.advance();
                }
                Ok(token(TokenKind::Word, self.text.get(start..self.at).unwrap_or("")))
            }
        }
    }

    /// Goes to the end of a string, which has to be on the same line.
    fn quoted(&mut self, spot: Spot) -> Result<()> {
        loop {
            match self.byte() {
                Some(b'"') => {
                    self.advance();
                    return Ok(());
                }
                Some(b'\\') => {
                    return Err(self.end().error("the string has a backslash").help("write / in file names"));
                }
                None | Some(b'\n') => {
                    return Err(spot.error("the string has no end on its line").help("add a closing \""));
                }
                Some(_) => self.advance(),
            }
        }
    }

    /// Passes over white space and comments.
    fn skip(&mut self) {
        let mut comment = false;
        while let Some(byte) = self.byte() {
            match byte {
                b'\n' => comment = false,
                b'#' => comment = true,
                b' ' | b'\t' | b'\r' => {}
                _ if comment => {}
                _ => return,
            }
            self.advance();
        }
    }

    fn byte(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    /// One byte on. Columns are counted in characters: a byte that goes on with a character is none.
    fn advance(&mut self) {
        let newline = self.byte() == Some(b'\n');
        self.at += 1;
        if newline {
            (self.line, self.column) = (self.line.saturating_add(1), 1);
        } else if self.byte().is_none_or(|byte| byte & 0xc0 != 0x80) {
            self.column = self.column.saturating_add(1);
        }
    }
}
