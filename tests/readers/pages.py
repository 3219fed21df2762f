"""Reads a PDF and tells how many pages it has, each of them an A3 page with strokes on it.

usage: pages.py FILE.pdf
"""
import sys

from pypdf import PdfReader


def main(path):
    reader = PdfReader(path, strict=True)
    for page in reader.pages:
        sides = sorted(round(float(side) / 72 * 25.4) for side in page.mediabox[2:])
        assert sides == [297, 420], sides
        content = page.get_contents().get_data().decode("ascii")
        operators = content.split()
        assert operators.count("m") > 100 and operators.count("c") > 100, "hardly anything is drawn"
        assert operators.count("S") + operators.count("s") + operators.count("b") > 100
    assert reader.metadata.title and reader.metadata.creation_date is None
    print(len(reader.pages), "A3")


main(sys.argv[1])
