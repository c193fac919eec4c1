#!/usr/bin/env python3
"""Checks the documents of the source tree: their length, their sentences, and that what they show and name exists. Without --check all checks run.

  words      the pages have at most so many words together
  sentences  no sentence is longer than a reader keeps in mind
  names      each name and path in the pages that walk through the code is one of the sources
  walks      a key press and an update are each walked in few hops, and a key moves its bat after few functions
  links      each link within the tree leads to a file, and to a heading of it; so does each "heading" named behind a link
  samples    each C++ sample of the first pages is part of the compiled file that the comment above it names: <!-- from PATH -->
"""
import argparse
import pathlib
import re
import sys

WORDS_MAX, SENTENCE_WORDS_MAX = 30_000, 40
HOPS_MAX, FUNCTIONS_TO_BAT_MAX = 12, 30

# Those whose every name in `code` is one of the sources, and those whose samples of C++ are compiled elsewhere.
PAGES_OF_NAMES = ("docs/architecture.md", "docs/key-press.md")
PAGES_OF_SAMPLES = ("docs/start-federate.md", "docs/start-scheme.md", "docs/hla.md")

CODE_FOLDERS = ("bench", "game", "im", "loadgen", "rti", "tests")
FENCE = re.compile(r"^```.*?^```$", re.MULTILINE | re.DOTALL)
# Written by ./rink results, not by a person.
MEASURED = re.compile(r"^<!-- measured by .*?^<!-- end of what is measured -->$", re.MULTILINE | re.DOTALL)
BLOCK_BEGINS = re.compile(r"^\s*([-*]|\d+\.) |^\s*$|^#|^<!--|^\|")
NOT_PROSE = re.compile(r"^(#|\||<!--|!\[| {4})")
LINK = re.compile(r"\]\((?!https?:)([^()#\s]*)(?:#([^()\s]*))?\)(?:,\s+\"([^\"]+)\")?")
SAMPLE = re.compile(r"((?:^[^\n]*\n)?)^```cpp\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def pages(root):
    return [root / "README.md", root / "CONTRIBUTING.md", *sorted((root / "docs").rglob("*.md"))]


def check_words(root):
    counts = {page.relative_to(root): len(page.read_text().split()) for page in pages(root)}
    total = sum(counts.values())
    print(f"{total} words on {len(counts)} pages")
    return [] if total <= WORDS_MAX else [f"the pages have {total} words, more than {WORDS_MAX}: cut what is said twice"]


def prose_blocks(text):
    """Paragraphs and items of lists, each as one line, without code, tables, headings and what is measured."""
    text = MEASURED.sub("", FENCE.sub("", text))
    block = []
    for line in [*text.splitlines(), ""]:
        if BLOCK_BEGINS.match(line):
            yield " ".join(block)
            block = []
        if not NOT_PROSE.match(line) or (block and line.startswith("  ")):
            block.append(line.strip())


def sentences(block):
    block = re.sub(r"!?\[([^][]*)\]\([^()]*\)", r"\1", re.sub(r"`[^`]*`", "code", block))
    return re.split(r"(?<=[.!?])[)*\"]* +(?=\W*[A-Z0-9a-z])", block)


def check_sentences(root):
    complaints = []
    for page in pages(root):
        for block in prose_blocks(page.read_text()):
            for sentence in sentences(block):
                count = sum(1 for word in sentence.split() if re.search(r"\w", word))
                if count > SENTENCE_WORDS_MAX:
                    complaints.append(f"{page.relative_to(root)}: {count} words: {sentence}")
    return complaints


def sources_of(root):
    return [path for folder in CODE_FOLDERS for path in (root / folder).rglob("*") if path.suffix in (".h", ".cpp")]


def is_declared(name, text):
    """Whether the sources declare `name`; of `Class::member` whether one file declares both, or a source defines it."""
    owner, _, member = name.rpartition("::")
    if not owner:
        return re.search(rf"\b{name}\b", text["all"]) is not None
    if f"{name}(" in text["all"] or f"{name}<" in text["all"]:
        return True
    opening = re.compile(rf"\b(class|struct|enum class) (\[\[\w+\]\] )?{owner}\b[^;{{]*\{{")
    return any(opening.search(each) and re.search(rf"\b{member}\b", each) for each in text["headers"])


def check_names(root):
    sources = sources_of(root)
    headers = [path.read_text() for path in sources if path.suffix == ".h"]
    text = {"all": "\n".join(path.read_text() for path in sources), "headers": headers}
    commands = {path.name.removesuffix("_main.cpp") for path in sources if path.name.endswith("_main.cpp")}
    complaints = []
    for page in PAGES_OF_NAMES:
        for code in sorted(set(re.findall(r"`([^`]+)`", FENCE.sub("", (root / page).read_text())))):
            if code.startswith("rink "):
                exists = code.split()[1] in commands
            elif "/" in code or re.search(r"\.(h|cpp|md|py|toml)$", code):
                exists = (root / code).exists()
            elif re.fullmatch(r"\w+(::\w+)*", code):
                exists = is_declared(code, text) or (root / code).is_dir()
            else:
                complaints.append(f"{page}: `{code}` is neither a name nor a path")
                continue
            if not exists:
                complaints.append(f"{page}: `{code}` does not exist")
    return complaints


def check_walks(root):
    page = "docs/key-press.md"
    walks = re.findall(r"^\|hop\|.*\n\|[-|]+\|\n((?:\|.*\n)+)", (root / page).read_text(), re.MULTILINE)
    if len(walks) != 2:
        return [f"{page}: has {len(walks)} walks, not that of a key press and that of an update"]
    complaints = [f"{page}: a walk has {hops} hops, more than {HOPS_MAX}" for hops in map(len, map(str.splitlines, walks)) if hops > HOPS_MAX]
    to_bat, arrives, _ = walks[0].partition("World::set_thrust`")
    functions = len(re.findall(r"`\w+::\w+", to_bat + arrives))
    print(f"{functions} functions from key to bat")
    if not arrives or functions > FUNCTIONS_TO_BAT_MAX:
        complaints.append(f"{page}: a key does not move its bat within {FUNCTIONS_TO_BAT_MAX} functions")
    return complaints


def headings(page):
    return re.findall(r"^#+ (.*)$", FENCE.sub("", page.read_text()), re.MULTILINE)


def anchor_of(heading):
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def check_links(root):
    complaints = []
    for page in pages(root):
        for path, anchor, heading in LINK.findall(FENCE.sub("", page.read_text())):
            target = page.parent / path if path else page
            if not target.exists():
                complaints.append(f"{page.relative_to(root)}: there is no {path}")
            elif anchor and anchor not in map(anchor_of, headings(target)):
                complaints.append(f"{page.relative_to(root)}: {path} has no heading #{anchor}")
            elif heading and not any(each.startswith(heading) for each in headings(target) + re.findall(r"\*\*?([^*]+?)\.?\*\*?", target.read_text())):
                complaints.append(f"{page.relative_to(root)}: {path} has no part \"{heading}\"")
    return complaints


def check_samples(root):
    complaints = []
    for page in PAGES_OF_SAMPLES:
        samples = SAMPLE.findall((root / page).read_text())
        if not samples:
            complaints.append(f"{page}: shows no sample of C++")
        for before, sample in samples:
            source = re.fullmatch(r"<!-- from (\S+) -->\n", before)
            if not source:
                complaints.append(f"{page}: a sample follows no line <!-- from PATH -->")
            elif not (root / source[1]).is_file():
                complaints.append(f"{page}: there is no {source[1]}")
            elif sample not in (root / source[1]).read_text():
                complaints.append(f"{page}: a sample is no part of {source[1]}, letter by letter")
    return complaints


CHECKS = {"words": check_words, "sentences": check_sentences, "names": check_names, "walks": check_walks, "links": check_links, "samples": check_samples}


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[2], help="of the source tree")
    arguments.add_argument("--check", choices=CHECKS, action="append", help="only this one")
    options = arguments.parse_args()
    complaints = [complaint for name in options.check or CHECKS for complaint in CHECKS[name](options.root)]
    print("\n".join(complaints) or "all is well")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
