#!/usr/bin/env python3
"""How much a reader of the reports has to read: prose.py [--bounds] reports/*/report.md

Prose is what remains of a report without tables, pictures, captions (lines in italics) of up to 40 words, code, headings, the author's
notes, the way to run it again and the references. A cell of a table of more than 8 words is prose too, but for the card, the table without
a header. Of each report: all words, words of prose, sentences, words of the longest sentence, sentences above 30 words, and sentences that
list more than three cases (four commas or semicolons and more). With --bounds it fails where a bound is exceeded.
"""
import re
import sys

SKIP = ('notes', 'how to run it again', 'references', 'set-up', 'sources')
CAPTION, CELL = 40, 8
SENTENCE, REPORT, AVERAGE, ALL = 30, 800, 480, 3600


def cells(row):
    return [cell.strip() for cell in re.split(r'(?<!\\)\|', row)[1:-1]]


def prose(text):
    out, skip, code, card, table = [], False, False, False, False
    for line in text.splitlines():
        if line.startswith('```'):
            code = not code
            continue
        if code:
            continue
        if line.startswith('#'):
            skip = line.lstrip('# ').strip().lower() in SKIP
            continue
        s = line.strip()
        if not s.startswith('|'):
            table = False
        elif not skip:
            if not table:
                table, card = True, not any(cells(s))
            if not card:
                out.extend(cell for cell in cells(s) if len(cell.split()) > CELL)
        caption = s.startswith('*') and s.endswith('*') and not s.startswith('**')
        if skip or not s or s.startswith(('|', '![', '<')) or caption and len(s.split()) <= CAPTION:
            continue
        out.append(re.sub(r'^(>|-|\*|\d+\.)\s+', '', s))
    return out


def sentences(lines):
    for line in lines:
        for s in re.split(r'(?<=[.!?])\s+(?=[A-Z"`*])', line):
            if len(s.split()) > 2:
                yield s


def count(text):
    """Words, words of prose, sentences, words of the longest one, sentences above 30 words, and lists."""
    lines = prose(text)
    s = list(sentences(lines))
    n = [len(x.split()) for x in s]
    lists = sum(len(re.findall(r'[,;]', x)) >= 4 for x in s)
    return [len(text.split()), sum(len(x.split()) for x in lines), len(s), max(n, default=0), sum(k > SENTENCE for k in n), lists]


def exceeded(rows):
    """The bounds that are exceeded by reports, of which each is a name with its counts."""
    all_prose = sum(row[1] for _, row in rows)
    faults = [f'{name}: {row[1]} words of prose, more than {REPORT}' for name, row in rows if row[1] > REPORT]
    faults += [f'{name}: {row[4]} sentences of more than {SENTENCE} words' for name, row in rows if row[4]]
    if all_prose > ALL:
        faults.append(f'{all_prose} words of prose in all, more than {ALL}')
    if all_prose > AVERAGE * len(rows):
        faults.append(f'{all_prose / len(rows):.0f} words of prose a report, more than {AVERAGE}')
    return faults


def main(arguments):
    paths = [path for path in arguments if path != '--bounds']
    print(f'{"report":34} {"words":>7} {"prose":>7} {"sent.":>6} {"longest":>8} {">30":>5} {"lists":>6}')
    rows = [(path.split('/')[-2], count(open(path, encoding='utf-8').read())) for path in paths]
    for name, row in rows:
        print(f'{name:34} {row[0]:7} {row[1]:7} {row[2]:6} {row[3]:8} {row[4]:5} {row[5]:6}')
    total = [sum(row[k] for _, row in rows) for k in range(6)]
    print(f'{"all":34} {total[0]:7} {total[1]:7} {total[2]:6} {"":8} {total[4]:5} {total[5]:6}')
    if '--bounds' in arguments and (faults := exceeded(rows)):
        sys.exit('\n'.join(faults))


if __name__ == '__main__':
    main(sys.argv[1:])
