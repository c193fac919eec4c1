#!/usr/bin/env python3
"""How many member functions and data members each class of the product has, and which have too many.

A function is counted by its name, however often it is overloaded; constructors, destructors and assignments are not. A record without functions may have as many
members as it likes. Example:
  tests/house/class_weight.py --list 20
"""
import argparse
import pathlib
import re
import sys

FUNCTIONS_MAX, DATA_MAX = 40, 20

# Whose width the HLA standard sets, what only forwards to them, and records whose few functions only copy, compare or write their members.
EXCEPTED = {"Ambassador", "FederateAmbassador", "RTIambassador", "NullFederateAmbassador", "CallbackQueue", "Receiver", "BodyState", "Counters", "Experiment", "RunRecord"}

FOLDERS = ("rti", "im", "game", "loadgen", "bench")
OPENING = re.compile(r"\b(?:class|struct)\s+(?:\[\[\w+\]\]\s*)?(?:alignas\([^)]*\)\s*)?([\w:]+)(?:<[^;{}()]*>)?\s*(?:final\s*)?(?::(?!:)[^;{}]*)?\{")
NOT_MEMBERS = re.compile(r"^(using|typedef|friend|static_assert|enum|class|struct|union|public|private|protected)\b")
QUOTED = re.compile(r'R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'', re.DOTALL)


def bare(text):
    """The source without comments, preprocessor lines and what is quoted."""
    text = re.sub(r"//[^\n]*", "", re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL))
    text = QUOTED.sub('""', re.sub(r"(?<=\d)'(?=\d)", "", text))
    return re.sub(r"^\s*#(?:\\\n|[^\n])*", "", text, flags=re.MULTILINE)


def end_of_block(text, begin):
    """Just behind the brace that closes the one at `begin`."""
    depth = 0
    for place in range(begin, len(text)):
        depth += {"{": 1, "}": -1}.get(text[place], 0)
        if depth == 0:
            return place + 1
    raise ValueError("a brace is never closed")


def without(text, opening, closing):
    """`text` with whatever stands between the brackets, and they, left out."""
    kept, depth = [], 0
    for place, letter in enumerate(text):
        if letter == opening:
            depth += 1
        elif letter == closing and depth > 0 and text[place - 1] != "-":
            depth -= 1
        elif depth == 0:
            kept.append(letter)
    return "".join(kept)


def statements(body):
    """The declarations of a class, each without the bodies of what it defines."""
    begin = place = 0
    head = ""
    while place < len(body):
        if body[place] == "{":
            head += body[begin:place]
            place = begin = end_of_block(body, place)
            rest = re.match(r"\s*(?=[;,])", body[place:])
            if re.match(r"\s*(template\s*<.*>\s*)?(class|struct|union|enum)\b", head, re.DOTALL) or rest is None:
                if rest is None:  # a function with a body, or a class within this one
                    yield head
                    head = ""
        elif body[place] == ";":
            yield head + body[begin:place]
            head, begin = "", place + 1
            place += 1
        else:
            place += 1


def weigh(name, body):
    """The names of functions and of data members that a class declares."""
    functions, data = set(), set()
    for statement in statements(body):
        statement = re.sub(r"\b(public|private|protected)\s*:(?!:)", " ", statement).strip()
        statement = re.sub(r"\[\[.*?\]\]", "", statement)
        declared = without(statement, "<", ">")
        declared = re.sub(r"^\s*template\b", "", declared)
        declared = re.sub(r"\balignas\s*\([^()]*\)", "", re.sub(r"\bdecltype\s*\([^()]*\)", "auto", declared)).strip()
        if not declared or NOT_MEMBERS.match(declared):
            continue
        call = re.search(r"(operator\s*\S+?|~?\w+)\s*\(", declared)
        value = declared.find("=")
        if call and (value < 0 or call.start() < value or call[1].startswith("operator")):
            called = call[1]
            if called.lstrip("~") != name and not re.match(r"operator\s*=$", called):
                functions.add(called)
        elif not re.search(r"\bstatic\b|\bconstexpr\b", declared):
            for part in without(declared, "[", "]").split(","):
                words = re.findall(r"\w+", re.split(r"=|(?<!:):(?!:)", part)[0])
                if words:
                    data.add(words[-1])
    return functions, data


def classes(text):
    for found in OPENING.finditer(text):
        if re.search(r"\benum\s+$", text[:found.start()][-12:]):
            continue
        yield found[1].split("::")[-1], text[found.end():end_of_block(text, found.end() - 1) - 1]


def weights(root):
    """For each class its file, functions and data members."""
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in (".h", ".cpp"):
                for name, body in classes(bare(path.read_text())):
                    yield (str(path.relative_to(root)), name, *weigh(name, body))


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[2], help="of the source tree")
    arguments.add_argument("--list", type=int, default=0, metavar="N", help="only print the N classes with most functions and the N with most data members")
    options = arguments.parse_args()
    found = list(weights(options.root))
    if options.list:
        with_functions = [entry for entry in found if entry[2]]
        for order in (2, 3):
            print("functions  data" if order == 2 else "\nby data members")
            for path, name, functions, data in sorted(with_functions, key=lambda entry: -len(entry[order]))[:options.list]:
                print(f"{len(functions):9}  {len(data):4}  {name}  {path}")
        return 0
    wrong = [f"{path}: {name} has {len(functions)} member functions and {len(data)} data members" for path, name, functions, data in found
             if functions and name not in EXCEPTED and (len(functions) > FUNCTIONS_MAX or len(data) > DATA_MAX)]
    print("\n".join(wrong) or f"{len(found)} classes; none has above {FUNCTIONS_MAX} member functions or {DATA_MAX} data members")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
