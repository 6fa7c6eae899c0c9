"""From a shader's text to its syntax tree, by recursive descent."""

import re
from collections.abc import Callable
from typing import Any, Final

from vexture.renderers.shader import ShaderError
from wgsl_generator.syntax import (
    Array,
    Assign,
    Binary,
    Block,
    Branch,
    Call,
    Case,
    Choice,
    Conditional,
    Constant,
    Declare,
    Default,
    Define,
    Evaluate,
    Expression,
    Field,
    For,
    Function,
    If,
    Index,
    Item,
    Jump,
    Member,
    Name,
    Number,
    Parameter,
    Remarks,
    Return,
    Statement,
    Step,
    Struct,
    Switch,
    Top,
    Unary,
    Uniform,
    While,
)
from wgsl_generator.tokens import Token, tokens_of

LEVELS: Final = (
    ("||",),
    ("^^",),
    ("&&",),
    ("|",),
    ("^",),
    ("&",),
    ("==", "!="),
    ("<", ">", "<=", ">="),
    ("<<", ">>"),
    ("+", "-"),
    ("*", "/", "%"),
)
"""Signs between values, from those that bind least."""

ASSIGNING: Final = {"=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>="}
PRECISIONS: Final = {"highp", "mediump", "lowp"}
TYPE: Final = re.compile(r"void|bool|u?int|float|[iub]?vec[234]|mat3|u?sampler2D")
WORDS: Final = {"do", "goto", "discard", "in", "out", "const", "struct", "uniform", "varying", "attribute", "layout"}
CONDITION: Final = re.compile(r"#(?:el)?if\s+(\w+(?: == [\w.]+)?)")


def parse(text: str) -> tuple[Top | Conditional, ...]:
    """Return the syntax tree of a text.

    Raises
    ------
    ShaderError
        With the line of what the subset does not hold.
    """
    return Parser(tokens_of(text)).file()


class Parser:
    """Reads one token after another."""

    def __init__(self, tokens: list[Token]) -> None:
        self.tokens = tokens
        self.at = 0
        self.structures: set[str] = set()

    @property
    def now(self) -> Token:
        """The next token."""
        return self.tokens[self.at]

    def ahead(self, count: int) -> Token:
        """One of those that follow it."""
        return self.tokens[min(self.at + count, len(self.tokens) - 1)]

    def take(self, text: str | None = None) -> Token:
        """Go on, past this text if one is given."""
        token = self.now
        if token.kind == "end":
            raise ShaderError(token.line, "the text ends within a statement")
        if text is not None and token.text != text:
            raise self.refused(f"{text!r} was expected")
        self.at += 1
        return token

    def takes(self, text: str) -> bool:
        """Whether this text was next; then go on past it."""
        found = self.now.text == text
        self.at += found
        return found

    def refused(self, message: str) -> ShaderError:
        """Error at the next token."""
        return ShaderError(self.now.line, f"{self.now.text!r}: {message}")

    def is_type(self, token: Token) -> bool:
        """Whether a token names a type."""
        return TYPE.fullmatch(token.text) is not None or token.text in self.structures

    def type(self) -> str:
        """A type's name."""
        if not self.is_type(self.now):
            raise self.refused("is no type of the subset")
        return self.take().text

    def name(self) -> str:
        """A new name."""
        if self.now.kind != "name" or self.is_type(self.now) or self.now.text in WORDS:
            raise self.refused("a name was expected")
        return self.take().text

    def size(self) -> str:
        """Parse the size behind an array's name, ``[3]``; empty behind others."""
        if not self.takes("["):
            return ""
        size = self.take().text
        while not self.takes("]"):
            size += f" {self.take().text}"
        return f"[{size}]"

    # --- outside of functions

    def file(self) -> tuple[Top | Conditional, ...]:
        """All of the text."""
        found: list[Top | Conditional] = []
        while self.now.kind != "end":
            found.append(self.top())
        return tuple(found)

    def top(self) -> Top | Conditional:
        first = self.now
        if first.kind == "directive":
            return self.conditional(self.top) if CONDITION.fullmatch(first.text) else self.define()
        if first.text == "struct":
            return self.struct()
        if first.text == "uniform":
            self.take()
            if self.now.text in PRECISIONS:
                self.take()
            type_, name = self.type(), self.name()
            size = self.size()
            return Uniform(first.line, Remarks(first.lead, self.take(";").trail), type_ + size, name)
        if self.ahead(2).text == "(" and first.text != "const":
            return self.function()
        is_const = self.takes("const")
        type_, name = self.type(), self.name()
        type_ += self.size()
        self.take("=")
        value = self.expression()
        remarks = Remarks(first.lead, self.take(";").trail)
        return Constant(first.line, remarks, "const" if is_const else "private", type_, name, value)

    def define(self) -> Top:
        token = self.take()
        unless = re.fullmatch(r"#ifndef (\w+)", token.text)
        line = self.take() if unless else token
        match = re.fullmatch(r"#define (\w+) (\(?-?[\w.+-]+\)?)", line.text)
        if match is None or (unless and unless[1] != match[1]):
            raise ShaderError(line.line, f"{line.text}: outside of functions stand only #define NAME NUMBER and #if")
        if unless:
            self.take("#endif")
        return (Default if unless else Define)(token.line, Remarks(token.lead, ""), match[1], match[2])

    def conditional(self, one: Callable[[], Any]) -> Conditional:
        """A conditional around things that a function reads one of."""
        first = self.now
        branches: list[Branch] = []
        while not self.takes("#endif"):
            token = self.take()
            match = CONDITION.fullmatch(token.text)
            if match is None and token.text != "#else":
                raise ShaderError(token.line, f"{token.text}: conditions are NAME or NAME == NUMBER")
            body = []
            while not (self.now.kind == "directive" and self.now.text.startswith(("#el", "#endif"))):
                body.append(one())
            branches.append(Branch(match[1] if match else None, tuple(body)))
        return Conditional(first.line, Remarks(first.lead), tuple(branches))

    def struct(self) -> Struct:
        first = self.take("struct")
        name = self.name()
        opening = self.take("{")
        fields: list[Field | Conditional] = []
        while not self.takes("}"):
            is_condition = self.now.kind == "directive"
            fields.append(self.conditional(self.field) if is_condition else self.field())
        self.take(";")
        self.structures.add(name)
        return Struct(first.line, Remarks(first.lead, opening.trail), name, tuple(fields))

    def field(self) -> Field:
        first = self.now
        type_, name = self.type(), self.name()
        return Field(first.line, Remarks(first.lead, self.take(";").trail), type_, name)

    def function(self) -> Function:
        first = self.now
        returns, name = self.type(), self.name()
        self.take("(")
        parameters = []
        while not self.takes(")"):
            is_inout = self.takes("inout")
            parameters.append(Parameter(self.type(), self.name(), is_inout))
            if self.now.text != ")":
                self.take(",")
        opening = self.now
        body = self.braced()
        return Function(first.line, Remarks(first.lead, opening.trail), returns, name, tuple(parameters), body)

    # --- statements

    def braced(self) -> tuple[Item, ...]:
        self.take("{")
        body = []
        while not self.takes("}"):
            body.append(self.item())
        return tuple(body)

    def item(self) -> Item:
        return self.conditional(self.item) if self.now.kind == "directive" else self.statement()

    def statement(self) -> Statement:
        first = self.now
        known: dict[str, Callable[[], Statement]] = {
            "{": self.block,
            "if": self.if_,
            "while": self.while_,
            "for": self.for_,
            "switch": self.switch,
            "return": self.return_,
        }
        if first.text in known:
            return known[first.text]()
        if first.text in ("break", "continue"):
            word = self.take().text
            return Jump(first.line, Remarks(first.lead, self.take(";").trail), word)
        return self.simple(";")

    def block(self) -> Block:
        first = self.now
        return Block(first.line, Remarks(first.lead, first.trail), self.braced())

    def head(self) -> tuple[Token, Expression, Token]:
        """A word, a condition in brackets, and the brace behind it."""
        first = self.take()
        self.take("(")
        condition = self.expression()
        self.take(")")
        return first, condition, self.now

    def if_(self) -> If:
        first, condition, opening = self.head()
        yes = self.braced()
        no: tuple[Item, ...] = ()
        if self.takes("else"):
            no = (self.if_(),) if self.now.text == "if" else self.braced()
        return If(first.line, Remarks(first.lead, opening.trail), condition, yes, no)

    def while_(self) -> While:
        first, condition, opening = self.head()
        return While(first.line, Remarks(first.lead, opening.trail), condition, self.braced())

    def for_(self) -> For:
        first = self.take("for")
        self.take("(")
        start = None if self.takes(";") else self.simple(";")
        condition = self.expression()
        self.take(";")
        step = self.simple(")")
        opening = self.now
        return For(first.line, Remarks(first.lead, opening.trail), start, condition, step, self.braced())

    def switch(self) -> Switch:
        first, value, opening = self.head()
        self.take("{")
        cases: list[Case] = []
        while not self.takes("}"):
            line, labels = self.now.line, []
            while self.now.text == "case":
                self.take()
                labels.append(self.expression())
                self.take(":")
            if not labels:
                self.take("default")
                self.take(":")
            body = []
            while self.now.text not in ("case", "default", "}"):
                body.append(self.item())
            cases.append(Case(line, tuple(labels), tuple(body)))
        return Switch(first.line, Remarks(first.lead, opening.trail), value, tuple(cases))

    def return_(self) -> Return:
        first = self.take("return")
        value = None if self.now.text == ";" else self.expression()
        return Return(first.line, Remarks(first.lead, self.take(";").trail), value)

    def simple(self, end: str) -> Statement:
        """A declaration, an assignment, a step or a call."""
        first = self.now
        if self.is_type(first) and self.ahead(1).kind == "name":
            type_, name = self.type(), self.name()
            type_ += self.size()
            value = self.expression() if self.takes("=") else None
            return Declare(first.line, Remarks(first.lead, self.take(end).trail), type_, name, value)
        target = self.postfix()
        if self.now.text in ("++", "--"):
            sign = self.take().text
            return Step(first.line, Remarks(first.lead, self.take(end).trail), target, sign)
        if self.now.text in ASSIGNING:
            sign = self.take().text
            value = self.expression()
            return Assign(first.line, Remarks(first.lead, self.take(end).trail), target, sign, value)
        if not isinstance(target, Call):
            raise self.refused("a statement is a declaration, an assignment or a call")
        return Evaluate(first.line, Remarks(first.lead, self.take(end).trail), target)

    # --- expressions

    def expression(self) -> Expression:
        line, condition = self.now.line, self.binary(0)
        if not self.takes("?"):
            return condition
        yes = self.expression()
        self.take(":")
        return Choice(line, condition, yes, self.expression())

    def binary(self, level: int) -> Expression:
        if level == len(LEVELS):
            return self.unary()
        left = self.binary(level + 1)
        while self.now.text in LEVELS[level]:
            token = self.take()
            left = Binary(token.line, token.text, left, self.binary(level + 1))
        return left

    def unary(self) -> Expression:
        if self.now.text in ("-", "!", "~"):
            token = self.take()
            return Unary(token.line, token.text, self.unary())
        return self.postfix()

    def postfix(self) -> Expression:
        value = self.primary()
        while self.now.text in (".", "["):
            token = self.take()
            if token.text == ".":
                value = Member(token.line, value, self.take().text)
            else:
                value = Index(token.line, value, self.expression())
                self.take("]")
        return value

    def primary(self) -> Expression:
        token = self.take()
        if token.text == "(":
            value = self.expression()
            self.take(")")
            return value
        if token.kind == "number" or token.text in ("true", "false"):
            return Number(token.line, token.text)
        if token.kind != "name" or token.text in WORDS:
            raise ShaderError(token.line, f"{token.text!r}: a value was expected")
        if self.is_type(token) and self.now.text == "[":
            return Array(token.line, token.text + self.size(), self.arguments())
        if self.now.text == "(":
            return Call(token.line, token.text, self.arguments())
        return Name(token.line, token.text)

    def arguments(self) -> tuple[Expression, ...]:
        self.take("(")
        given = []
        while not self.takes(")"):
            given.append(self.expression())
            if self.now.text != ")":
                self.take(",")
        return tuple(given)
