"""Reads the workbook with openpyxl: every table is in it, cell by cell, numbers as numbers.

usage: workbook.py FOLDER
"""
import csv
import os
import re
import sys

from openpyxl import load_workbook

TABLES = {
    "Summary": "summary",
    "Shopping": "bom",
    "Cut list": "cutlist",
    "Crossings": "crossings",
    "Stickers": "stickers",
    "Supports": "supports",
}
NUMBER = re.compile(r"-?(0|[1-9][0-9]*)(\.[0-9]+)?$")


def main(folder):
    book = load_workbook(os.path.join(folder, "bill.xlsx"))
    there = [name for name, file in TABLES.items() if os.path.exists(os.path.join(folder, file + ".csv"))]
    assert book.sheetnames == there, book.sheetnames
    assert book.properties.created.year == 2000, "the same bytes on every day"
    numbers = texts = 0
    for name in there:
        rows = list(csv.reader(open(os.path.join(folder, TABLES[name] + ".csv"), encoding="utf-8", newline="")))
        sheet = book[name]
        assert (sheet.max_row, sheet.max_column) == (len(rows), len(rows[0])), name
        assert sheet.freeze_panes == "A2"
        for r, row in enumerate(rows):
            for c, text in enumerate(row):
                cell = sheet.cell(r + 1, c + 1)
                if r > 0 and NUMBER.match(text):
                    assert cell.data_type == "n" and float(text) == cell.value, (name, text, cell.value)
                    shown = cell.number_format.split(".")
                    assert len(shown[1:] and shown[1]) == len(text.partition(".")[2]), cell.number_format
                    numbers += 1
                else:
                    assert (cell.value or "") == text, (name, text, cell.value)
                    texts += bool(text)
    assert numbers > 100 and texts > 100
    print(*there, sep=", ")


main(sys.argv[1])
