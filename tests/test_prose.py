"""What counts as prose, and what exceeds a bound."""
from prose import count, exceeded, prose

REPORT = """# Title

|  |  |
| --- | --- |
| **Why** | a card may have more than eight words in each of its cells |

Two words of it. Then a sentence of seven words.

*A caption of some words.*

| a | b |
| --- | --- |
| short | one two three four five six seven eight |
| long | one two three four five six seven eight nine |

## Notes

These words are the author's own.
"""


def test_tables_captions_and_notes_are_no_prose_but_long_cells_are():
    assert prose(REPORT) == [
        'Two words of it. Then a sentence of seven words.',
        'one two three four five six seven eight nine',
    ]
    long_caption = '*' + 'word ' * 41 + '*'
    assert prose(long_caption) == [long_caption]


def test_bounds():
    good = count('Few words.\n')
    assert exceeded([('a', good)] * 30) == []
    long = count('word ' * 31 + '\n')
    assert exceeded([('a', long)]) == ['a: 1 sentences of more than 30 words']
    many = count('A sentence of five words. ' * 161)
    assert exceeded([('b', many), ('c', good)]) == ['b: 805 words of prose, more than 800']
    assert any('in all' in fault for fault in exceeded([('d', count('A sentence of five words. ' * 150))] * 5))
