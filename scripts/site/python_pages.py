"""The reference of the Python package, from its docstrings. Nothing is imported."""

import ast
import re
from pathlib import Path

MODULES = ["__init__", "environment", "vector", "problem_properties", "problems", "states", "model", "learners",
           "plan", "gradients", "evaluation", "registration", "callbacks", "transitions", "causes", "errors", "adapters/sb3",
           "adapters/skdecide", "adapters/rllib", "adapters/pyrddlgym"]
OPTION = re.compile(r"^\w+(?:, \w+)*: ")


def prose(docstring: str | None) -> list[str]:
    """Returns a docstring as Markdown: lines such as 'seed: the seed' are a list."""
    out: list[str] = []
    text = re.sub(r"\n\nOver 400 lines: .*?(?=\n\n|$)", "", docstring or "", flags=re.S)
    for line in text.splitlines():
        if OPTION.match(line):
            if out and out[-1] and not out[-1].startswith(("* ", "  ")):
                out.append("")
            name, text = line.split(": ", 1)
            out.append(f"* `{name}`: {text}")
        else:
            out.append(line)
    return [*out, ""]


def signature(node: ast.FunctionDef, of_class: bool) -> str:
    arguments = ast.unparse(node.args)
    if of_class:
        arguments = re.sub(r"^(self|cls)(, )?", "", arguments)
    result = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    return f"{node.name}({arguments}){result}"


def is_property(node: ast.FunctionDef) -> bool:
    return any("property" in ast.unparse(decorator) for decorator in node.decorator_list)


def member(node: ast.stmt, of: str) -> list[str]:
    assert isinstance(node, ast.FunctionDef)
    text = signature(node, True).replace("__init__", of)
    if is_property(node):
        text = text.replace("()", "", 1)
    return [*([] if node.name == "__init__" else [f"### {of}.{node.name}", ""]), "```python", text, "```", "", *prose(ast.get_docstring(node))]


def class_text(node: ast.ClassDef) -> list[str]:
    bases = ", ".join(f"`{ast.unparse(base)}`" for base in node.bases)
    out = [f"## {node.name}", "", f"Bases: {bases}" if bases else "", "", *prose(ast.get_docstring(node))]
    for inner in node.body:
        if isinstance(inner, ast.FunctionDef) and (not inner.name.startswith("_") or inner.name == "__init__"):
            if ast.get_docstring(inner) or inner.name == "__init__":
                out += member(inner, node.name)
        elif isinstance(inner, ast.AnnAssign) and not ast.unparse(inner.target).startswith("_"):
            out += [f"* `{ast.unparse(inner.target)}: {ast.unparse(inner.annotation)}`"]
    return [*out, ""]


def page(root: Path, module: str) -> str:
    tree = ast.parse((root / f"{module}.py").read_text())
    name = "rddlc" if module == "__init__" else "rddlc." + module.removeprefix("adapters/")
    out = [f"# {name}", "", *prose(ast.get_docstring(tree))]
    for node in tree.body:
        if getattr(node, "name", "_").startswith("_"):
            continue
        if isinstance(node, ast.ClassDef) and ast.get_docstring(node):
            out += class_text(node)
        elif isinstance(node, ast.FunctionDef) and ast.get_docstring(node):
            out += [f"## {node.name}", "", "```python", signature(node, False), "```", "", *prose(ast.get_docstring(node))]
    return "\n".join(out) + "\n"


def file(module: str) -> str:
    return "rddlc.md" if module == "__init__" else module.split("/")[-1] + ".md"
