"""What tests that play share: one compiled game for each class.

They need the engine: FULLBRIGHT=path of the program, or FULLBRIGHT_BUILD=folder that it was built in."""

import os
import pathlib
import tempfile
import unittest

from qc.make import HERE, CompileError, compile_progs
from qc.testing.game import Game


def engine_path() -> pathlib.Path:
    built = pathlib.Path(os.environ.get("FULLBRIGHT_BUILD", ".")) / "fullbright"
    return pathlib.Path(os.environ.get("FULLBRIGHT", built))


class PlayCase(unittest.TestCase):
    game: Game
    extra: tuple[pathlib.Path, ...] = ()  # compiled behind the game

    @classmethod
    def setUpClass(cls):
        if not engine_path().is_file():
            raise unittest.SkipTest("neither FULLBRIGHT nor FULLBRIGHT_BUILD leads to a program to play with")
        try:
            progs = compile_progs(HERE, *cls.extra)
        except CompileError as error:
            if "not installed" in str(error):
                raise unittest.SkipTest(str(error)) from error
            raise
        cls._folder = tempfile.TemporaryDirectory()
        cls.game = Game(pathlib.Path(cls._folder.name), progs, engine_path())

    @classmethod
    def tearDownClass(cls):
        cls._folder.cleanup()
