"""What tests that play share: one compiled game for each class. They need the engine: FULLBRIGHT=path of the program."""

import os
import pathlib
import tempfile
import unittest

from qc.make import HERE, CompileError, compile_progs
from qc.testing.game import Game


class PlayCase(unittest.TestCase):
    game: Game
    extra: tuple[pathlib.Path, ...] = ()  # compiled behind the game

    @classmethod
    def setUpClass(cls):
        if not os.environ.get("FULLBRIGHT"):
            raise unittest.SkipTest("FULLBRIGHT names no program to play with")
        try:
            progs = compile_progs(HERE, *cls.extra)
        except CompileError as error:
            if "not installed" in str(error):
                raise unittest.SkipTest(str(error)) from error
            raise
        cls._folder = tempfile.TemporaryDirectory()
        cls.game = Game(pathlib.Path(cls._folder.name), progs)

    @classmethod
    def tearDownClass(cls):
        cls._folder.cleanup()
