"""GLSL whose uniforms are parameters: for engines that name textures themselves, or have several in a program."""

from vexture.renderers.shader import ShaderError
from wgsl_generator.facts import Facts, Form, facts_of
from wgsl_generator.kinds import TEXTURES
from wgsl_generator.parser import parse
from wgsl_generator.syntax import FRAGMENT
from wgsl_generator.tokens import Token, tokens_of


def with_parameters(text: str) -> str:
    r"""Return a text in which each function is given the uniforms that it reads, before all else.

    Parameters
    ----------
    text : str
        GLSL that `wgsl_generator.to_wgsl` takes.

    Raises
    ------
    ShaderError
        As `wgsl_generator.to_wgsl`, if the syntax is outside of the subset.

    Examples
    --------
    >>> print(with_parameters("uniform float size;\nfloat half_size() { return 0.5 * size; }"))
    float half_size(float size) { return 0.5 * size; }
    """
    facts = facts_of(parse(text))
    names = {name for name, _ in facts.forms}
    tokens = tokens_of(text)
    pieces, at, depth, k = [], 0, 0, 0
    while k < len(tokens):
        token = tokens[k]
        depth += (token.text == "{") - (token.text == "}")
        if token.text == "uniform":
            last = next(n for n in range(k, len(tokens)) if tokens[n].text == ";")
            pieces.append(text[at : token.start])
            at, k = tokens[last].start + 1, last
            at += len(text[at:]) - len(text[at:].lstrip("\n"))
        elif token.text in names and tokens[k + 1].text == "(":
            form = form_at(facts, tokens, k)
            opening = tokens[k + 1].start + 1
            pieces.append(text[at:opening] + uniform_parameters(facts, form, is_declared=depth == 0))
            at = opening
        k += 1
    return "".join(pieces) + text[at:]


def form_at(facts: Facts, tokens: list[Token], at: int) -> Form:
    """The form of the function that is called or defined at a token, by the number of commas in its brackets."""
    depth, commas, is_empty = 0, 0, tokens[at + 2].text == ")"
    for token in tokens[at + 1 :]:
        depth += (token.text in "([") - (token.text in ")]")
        commas += token.text == "," and depth == 1
        if depth == 0:
            break
    form = facts.forms.get((tokens[at].text, 0 if is_empty else commas + 1))
    if form is None:
        raise ShaderError(tokens[at].line, f"{tokens[at].text} has no form of {commas + 1} parameters")
    return form


def uniform_parameters(facts: Facts, form: Form, *, is_declared: bool) -> str:
    """The uniforms before a function's own parameters, or what it is given for these."""
    texts = []
    for name in form.reads:
        if name != FRAGMENT:  # GLSL has it anywhere
            type_ = facts.uniforms[name]
            precision = "highp " if type_ in TEXTURES else ""
            texts.append(f"{precision}{type_} {name}" if is_declared else name)
    return ", ".join(texts) + (", " if texts and form.parameters else "")
