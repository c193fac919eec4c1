#!/usr/bin/env python3
"""Which functions of the product take more than five parameters, constructors and lambdas among them.

Who needs more hands over a record whose members have names. Example:
  tests/house/parameter_count.py --list 5
"""
import argparse
import pathlib
import re
import sys

from class_weight import FOLDERS, bare, end_of_block

PARAMETERS_MAX = 5

# Whose parameters somebody else has fixed: the HLA standard, or the C library that calls them.
EXCEPTED = {"reflectAttributeValues", "receiveInteraction", "removeObjectInstance"}

SCOPE = re.compile(r"^\s*(?:(?:inline\s+)?namespace\b|extern\s*\"\"|(?:template\s*<.*>\s*)?(?:class|struct|union|enum)\b(?!.*\)\s*(?:const\b)?\s*$))", re.DOTALL)
NAMED = re.compile(r"(operator\s*(?:\(\)|\[\]|[^\s\w(]+)|~?\w+)\s*\(")
LAMBDA = re.compile(r"(?:\b(\w+)\s*=\s*)?(?<![\w\])])\[[^\[\];{}]*\]\s*\(")
NOT_FUNCTIONS = re.compile(r"^\s*(?:using|typedef|static_assert|if|for|while|switch|return)\b")


def parameters(text, begin):
    """How many parameters the list has whose parenthesis opens just before `begin`, and where it ends."""
    depth, count, has_any = 0, 0, False
    for place in range(begin, len(text)):
        letter = text[place]
        if letter == ")" and depth == 0:
            return count + has_any, place
        depth += {"(": 1, "[": 1, "{": 1, "<": 1, ")": -1, "]": -1, "}": -1}.get(letter, 0) - (letter == ">" and text[place - 1] != "-")
        count += letter == "," and depth == 0
        has_any = has_any or not letter.isspace()
    return 0, len(text)


def outside_angles(text):
    """`text` with what stands between angle brackets blanked, so that places stay what they are."""
    kept, depth = [], 0
    for place, letter in enumerate(text):
        if letter == "<" and not text[:place].rstrip().endswith("operator"):
            depth += 1
        kept.append(" " if depth else letter)
        if letter == ">" and depth and text[place - 1] != "-":
            depth -= 1
    return "".join(kept)


def heads(text):
    """Every declaration outside functions' bodies, each up to its body or its semicolon, and where it begins."""
    begin = place = 0
    while place < len(text):
        letter = text[place]
        if letter == "{":
            yield begin, text[begin:place]
            place = place + 1 if SCOPE.match(text[begin:place]) else end_of_block(text, place)
            begin = place
            continue
        if letter in ";}":
            yield begin, text[begin:place]
            begin = place + 1
        place += 1


def declared(text):
    """The name, place and number of parameters of each function and lambda."""
    for begin, head in heads(text):
        head = re.sub(r"\b(?:public|private|protected)\s*:(?!:)|\[\[[^\]]*\]\]|\b(?:alignas|decltype|noexcept|explicit|requires)\s*\([^()]*\)", lambda found: " " * len(found[0]), head)
        found = NAMED.search(outside_angles(head))
        value = re.search(r"(?<!operator)(?<![=!<>])=(?!=)", outside_angles(head))
        if found is None or head.lstrip().startswith(",") or NOT_FUNCTIONS.match(head) or (value and value.start() < found.start()):
            continue
        yield found[1], begin + found.start(), parameters(head, found.end())[0]
    for found in LAMBDA.finditer(text):
        count, end = parameters(text, found.end())
        if re.match(r"\)\s*(?:mutable\b|noexcept\b|->|\{)", text[end:]):
            yield found[1] or "a lambda", found.start(), count


def functions(root):
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in (".h", ".cpp"):
                for name, place, count in declared(bare(path.read_text())):
                    yield str(path.relative_to(root)), name, count


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[2], help="of the source tree")
    arguments.add_argument("--list", type=int, default=0, metavar="N", help="only print the functions with at least N parameters")
    options = arguments.parse_args()
    found = list(functions(options.root))
    if options.list:
        print("\n".join(f"{count:3}  {name}  {path}" for path, name, count in sorted(found, key=lambda entry: -entry[2]) if count >= options.list))
        return 0
    wrong = [f"{path}: {name} takes {count} parameters" for path, name, count in found if count > PARAMETERS_MAX and name not in EXCEPTED]
    print("\n".join(wrong) or f"{len(found)} functions; none takes more than {PARAMETERS_MAX} parameters")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
