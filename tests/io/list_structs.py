#!/usr/bin/env python3
"""Lists every struct of the headers given: an #include for each header and a row of layout_test.cpp for each struct.

list_structs.py SHADERS OUT HEADER... ; headers are paths below the folder SHADERS.
"""
import re
import sys


def structs(text):
    """Names and members, in order; comments are gone, and a member may be one of several of its type."""
    text = re.sub(r"//[^\n]*", "", text)
    for name, body in re.findall(r"\bstruct (\w+) \{(.*?)\};", text, re.S):
        members = []
        for line in filter(None, (part.strip() for part in body.split(";"))):
            _, declared = line.split(None, 1)
            members += [re.sub(r"\[.*\]", "", one).strip() for one in declared.split(",")]
        yield name, members


def main(folder, out, headers):
    includes, rows = [], []
    for header in headers:
        with open(f"{folder}/{header}", encoding="utf-8") as file:
            found = list(structs(file.read()))
        includes += [f'#include "shaders/{header}"'] if found else []
        for name, members in found:
            offsets = ", ".join(f'{{"{m}", offsetof(io::{name}, {m})}}' for m in members)
            rows.append(f'{{"{name}", {{sizeof(io::{name}), {{{offsets}}}}}}},')
    with open(out, "w", encoding="utf-8") as file:
        file.write("\n".join(["#ifdef AG_INCLUDES", *includes, "#else", *rows, "#endif", ""]))


main(sys.argv[1], sys.argv[2], sys.argv[3:])
