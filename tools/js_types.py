"""Types of TypeScript as text of a page, with links to what is described."""

import html
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

Model = dict[str, Any]

TRIVIAL: Final = {"ArrayBufferLike", "ArrayBuffer"}
"""Arguments of a type that say nothing to a reader: they are its default."""

COMPOUND: Final = {"union", "intersection", "conditional", "typeOperator"}


def plain(text: str) -> str:
    """Return text for the inside of an HTML element in Markdown, in which nothing is markup."""
    escaped = html.escape(text, quote=False)
    return "".join(f"&#{ord(one)};" if one in "*_[]`\\|" else one for one in escaped)


def _has_default(one: Model) -> bool:
    """Whether a parameter may be left out; TypeDoc names the value of a property, too."""
    return one["variant"] == "param" and "defaultValue" in one


@dataclass(frozen=True, slots=True)
class Writer:
    """Writes types.

    Parameters
    ----------
    link : callable
        Address of the description of a type that is named, None if there is none.
    """

    link: Callable[[Model], str | None]

    def type(self, node: Model | None) -> str:
        """Return a type as HTML."""
        if node is None:
            return "any"
        written: str = getattr(self, f"_{node['type']}", self._other)(node)
        return written

    def parameters(self, signature: Model, separator: str = ", ") -> str:
        """Return the parameters of a function as HTML."""
        return separator.join(map(self._parameter, signature.get("parameters", [])))

    def generics(self, signature: Model) -> str:
        """Return the type parameters of a class or function as HTML."""
        found = []
        for one in signature.get("typeParameters", []):
            within = f" extends {self.type(one['type'])}" if "type" in one else ""
            default = f" = {self.type(one['default'])}" if "default" in one else ""
            found.append(plain(one["name"]) + within + default)
        return f"&lt;{', '.join(found)}&gt;" if found else ""

    def _parameter(self, one: Model) -> str:
        rest = "..." if one["flags"].get("isRest") else ""
        optional = "?" if one["flags"].get("isOptional") or _has_default(one) else ""
        return f"{rest}{plain(one['name'])}{optional}: {self.type(one['type'])}"

    def _other(self, node: Model) -> str:
        return plain(str(node.get("name", "unknown")))

    def _literal(self, node: Model) -> str:
        value = node["value"]
        return plain("null" if value is None else f"'{value}'" if isinstance(value, str) else str(value).lower())

    def _reference(self, node: Model) -> str:
        name, address = plain(node["name"]), self.link(node)
        shown = f'<a href="{address}">{name}</a>' if address else name
        given = [one for one in node.get("typeArguments", []) if one.get("name") not in TRIVIAL]
        if node["name"] == "VectorTexture":
            given = [one for one in given if one.get("name") != "PackedData"]  # its default
        return shown + (f"&lt;{', '.join(map(self.type, given))}&gt;" if given else "")

    def _union(self, node: Model) -> str:
        return plain(" | ").join(map(self._part, node["types"]))

    def _intersection(self, node: Model) -> str:
        return " &amp; ".join(map(self._part, node["types"]))

    def _part(self, node: Model) -> str:
        """Return a type as part of another one."""
        is_function = node["type"] == "reflection" and "signatures" in node["declaration"]
        return f"({self.type(node)})" if is_function or node["type"] in COMPOUND else self.type(node)

    def _array(self, node: Model) -> str:
        return self._part(node["elementType"]) + plain("[]")

    def _tuple(self, node: Model) -> str:
        return plain("[") + ", ".join(map(self.type, node.get("elements", []))) + plain("]")

    def _typeOperator(self, node: Model) -> str:  # noqa: N802 - the kinds are TypeDoc's
        return f"{node['operator']} {self.type(node['target'])}"

    def _indexedAccess(self, node: Model) -> str:  # noqa: N802
        return self.type(node["objectType"]) + plain("[") + self.type(node["indexType"]) + plain("]")

    def _query(self, node: Model) -> str:
        return f"typeof {self.type(node['queryType'])}"

    def _predicate(self, node: Model) -> str:
        return f"{plain(node['name'])} is {self.type(node.get('targetType'))}"

    def _conditional(self, node: Model) -> str:
        parts = (self.type(node[name]) for name in ("checkType", "extendsType", "trueType", "falseType"))
        return "{} extends {} ? {} : {}".format(*parts)

    def _reflection(self, node: Model) -> str:
        declared = node["declaration"]
        if "signatures" in declared:
            (first, *_) = declared["signatures"]
            return f"({self.parameters(first)}) =&gt; {self.type(first['type'])}"
        parts = [self._parameter(one) for one in declared.get("children", []) if "type" in one]
        for one in declared.get("indexSignatures", []):
            (key,) = one["parameters"]
            parts.append(f"{plain('[')}{self._parameter(key)}{plain(']')}: {self.type(one['type'])}")
        return "{ " + ", ".join(parts) + " }" if parts else "{}"
