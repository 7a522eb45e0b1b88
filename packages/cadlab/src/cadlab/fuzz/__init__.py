"""Spoils files of every format that is read, and looks whether each is read whole or refused in one line.

``python -m cadlab.fuzz`` is the command. Each case is a kind of file and a number, which give the same bytes each time:
a small sound file (``seeds``) with a few faults (``mutate`` and what it stands on). Children that live long read them
(``workers``), and ``judge`` says what came of it.
"""
