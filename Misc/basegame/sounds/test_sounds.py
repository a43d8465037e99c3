"""Tests of the sounds, as they stand in their files: what Quake asks of them, and what ears would notice.

    cd Misc/basegame && python3 -m unittest sounds.test_sounds
"""

from __future__ import annotations

import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import unittest

import numpy as np

BASEGAME = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(BASEGAME))

from formats import wav  # noqa: E402
from sounds import catalogue  # noqa: E402
from sounds.conventions import CATEGORIES, CONVENTIONS  # noqa: E402
from sounds.kit import modal  # noqa: E402
from sounds.kit.filters import fast_length, moving, respond  # noqa: E402
from sounds.kit.master import loudness  # noqa: E402
from sounds.kit.space import fold_long  # noqa: E402
from sounds.kit.waves import generator, sine, white  # noqa: E402
from sounds.music import tracks  # noqa: E402

NAMED_IN_CODE = re.compile(r'"([\w]+/[\w]+)\.wav"')


class EverySound(unittest.TestCase):
    """Each file is made once and asked everything."""

    @classmethod
    def setUpClass(cls) -> None:
        cls.bytes = {name: catalogue.make(name).to_bytes() for name in catalogue.recipes()}
        cls.sounds = {name: wav.from_bytes(data) for name, data in cls.bytes.items()}

    def each(self, check) -> None:
        for name, sound in self.sounds.items():
            with self.subTest(name):
                check(CONVENTIONS[name], sound)

    def test_every_named_sound_has_a_recipe(self) -> None:
        self.assertEqual(set(self.sounds), set(CONVENTIONS))

    def test_code_names_no_other_sound(self) -> None:
        """What the QuakeC beside us precaches is made here."""
        for source in sorted((BASEGAME / "qc").rglob("*.qc")):
            for name in NAMED_IN_CODE.findall(source.read_text(encoding="utf-8")):
                self.assertIn(name, CONVENTIONS, source.name)

    def test_formats(self) -> None:
        for name, data in self.bytes.items():
            kind, channels, rate, _, width, bits = struct.unpack_from("<HHIIHH", data, 20)
            self.assertEqual((kind, channels, width, bits), (1, 1, 2, 16), name)
            self.assertIn(rate, (11025, 22050), name)
            self.assertEqual(struct.unpack_from("<I", data, 4)[0], len(data) - 8, name)

    def test_lengths(self) -> None:
        self.each(lambda c, s: self.assertTrue(c.shortest <= len(s.samples) / s.rate <= c.longest, len(s.samples) / s.rate))

    def test_nothing_clips(self) -> None:
        self.each(lambda c, s: self.assertLessEqual(np.max(np.abs(s.samples)), 0.9))

    def test_no_mean(self) -> None:
        self.each(lambda c, s: self.assertLess(abs(np.mean(s.samples)), 0.001))

    def test_loudness_of_category(self) -> None:
        def check(convention, sound) -> None:
            level, (target, tolerance) = loudness(sound.samples, sound.rate), CATEGORIES[convention.category]
            self.assertLess(abs(level - target), tolerance, f"{level:.1f} dB")

        self.each(check)

    def test_ends_are_at_rest(self) -> None:
        def check(convention, sound) -> None:
            ends = sound.samples[-1:] if sound.loop is None else sound.samples[:0]
            starts = sound.samples[:1] if sound.loop != 0 else sound.samples[:0]
            self.assertLess(np.max(np.abs(np.concatenate([starts, ends, [0.0]]))), 1e-4)

        self.each(check)

    def test_no_silence_before_or_behind(self) -> None:
        """A shot is heard when it is fired, and no channel is held for nothing."""

        def check(convention, sound) -> None:
            heard = np.nonzero(np.abs(sound.samples) > 0.001 * np.max(np.abs(sound.samples)))[0]
            self.assertLess(heard[0] / sound.rate, 0.03)
            self.assertLess((len(sound.samples) - heard[-1]) / sound.rate, 0.1)

        self.each(lambda c, s: check(c, s) if c.category != "silence" and s.loop is None else None)

    def test_loops_are_where_they_are_asked(self) -> None:
        self.each(lambda c, s: self.assertEqual(s.loop is not None, c.looped))

    def test_seams(self) -> None:
        """Over the seam the signal goes on as it does elsewhere: no step, no bend, no change of loudness."""

        def check(convention, sound) -> None:
            turn = sound.samples[sound.loop :]
            twice = np.concatenate([turn, turn])
            n = len(turn)
            for order in (1, 2, 3):
                steps = np.abs(np.diff(twice, order))
                at_seam = np.max(steps[n - order - 1 : n + 1])
                self.assertLessEqual(
                    at_seam, 1.02 * np.quantile(steps[: n - 4], 0.9999) + 2 / 32767, f"difference of order {order}"
                )

        self.each(lambda c, s: check(c, s) if s.loop is not None else None)

    def test_loudness_over_seams(self) -> None:
        """From 25 ms before the seam to 25 ms behind it the level changes no more than it does anywhere else."""

        def check(convention, sound) -> None:
            turn = sound.samples[sound.loop :]
            window = sound.rate // 40
            energy = np.concatenate([[0.0], np.cumsum(np.resize(turn, len(turn) + 2 * window) ** 2)])
            level = 10.0 * np.log10(energy[window:] - energy[:-window] + 1e-9)
            change = np.abs(level[window:] - level[:-window])
            seam = len(turn) - window
            elsewhere = np.concatenate([change[window : seam - window], change[seam + window :]])
            self.assertLess(change[seam], np.max(elsewhere) + 0.3)

        self.each(lambda c, s: check(c, s) if s.loop is not None else None)

    def test_lead_runs_into_loop(self) -> None:
        """What stands before the loop ends as the loop does, so that the first turn begins as every later one."""

        def check(convention, sound) -> None:
            tail = min(64, sound.loop)
            before, end = sound.samples[sound.loop - tail : sound.loop], sound.samples[-tail:]
            self.assertLess(np.max(np.abs(before - end)), 0.01)

        self.each(lambda c, s: check(c, s) if s.loop else None)

    def test_same_bytes_again(self) -> None:
        for name in ("weapons/r_exp3", "doors/stndr1", "ambience/drip1", "ogre/ogwake", "misc/talk"):
            self.assertEqual(catalogue.make(name).to_bytes(), self.bytes[name], name)

    def test_voices_differ(self) -> None:
        """No two files hold the same sound, whatever their names."""
        self.assertEqual(len(set(self.bytes.values())), len(self.bytes))


class Files(unittest.TestCase):
    def test_wave_goes_round(self) -> None:
        for bits, step in ((8, 1 / 127), (16, 1 / 32767)):
            given = wav.Wav(11025, np.linspace(-1.0, 1.0, 257), 100, bits)
            read = wav.from_bytes(given.to_bytes())
            self.assertEqual((read.rate, read.loop, read.bits), (11025, 100, bits))
            self.assertLessEqual(np.max(np.abs(read.samples - given.samples)), 0.5 * step + 1e-9)

    def test_loop_stands_where_quake_looks(self) -> None:
        """32 bytes into the cue chunk the start; the next chunk LIST, with `mark` at 28 and the length at 24."""
        data = wav.Wav(22050, np.zeros(1001), 40).to_bytes()
        cue = data.index(b"cue ")
        self.assertEqual(struct.unpack_from("<I", data, cue + 32)[0], 40)
        label = cue + 8 + struct.unpack_from("<I", data, cue + 4)[0]
        self.assertEqual((data[label : label + 4], data[label + 28 : label + 32]), (b"LIST", b"mark"))
        self.assertEqual(struct.unpack_from("<I", data, label + 24)[0], 961)

    def test_refusals(self) -> None:
        good = wav.Wav(22050, np.zeros(100)).to_bytes()
        for bad in (b"", b"RIFX" + good[4:], good[:20] + b"\3\0" + good[22:], good[:-50]):
            with self.assertRaises(ValueError):
                wav.from_bytes(bad)
        with self.assertRaises(ValueError):
            wav.Wav(22050, np.zeros(10), 10).to_bytes()


class Kit(unittest.TestCase):
    def test_filters_leave_alone_what_they_are_told_to(self) -> None:
        x = white(generator("test"), 2048)
        for loop in (False, True):
            self.assertLess(np.max(np.abs(moving(x, lambda f, p: np.ones((len(p), len(f))), loop=loop) - x)), 1e-9)
            self.assertLess(np.max(np.abs(respond(x, np.ones_like, loop) - x)), 1e-9)

    def test_strokes_begin_without_a_step(self) -> None:
        """The second difference at the first two samples, behind silence, is that of the tones at the end of a rise: a
        step would be as large as the largest that follows."""
        for name in ("IRON", "STEEL", "CHAIN", "COPPER", "BRONZE", "OAK", "SLATE", "CRYSTAL"):
            x = modal.ring(generator(name), getattr(modal, name), 440.0, 1.0)
            bends = np.abs(np.diff(np.concatenate([[0.0, 0.0], x]), 2))
            self.assertLess(np.max(bends[:2]), 0.1 * np.max(bends), name)

    def test_lengths_of_transforms_hold_the_signal(self) -> None:
        for n in (1, 2, 1000, 4097, 44100):
            self.assertTrue(n <= fast_length(n) <= 1.2 * n + 8)

    def test_folding_by_blocks_is_folding(self) -> None:
        g = generator("test")
        x, response = white(g, 5000), white(g, 300)
        self.assertLess(np.max(np.abs(fold_long(x, response, 1024) - np.convolve(x, response)[:5000])), 1e-9)

    def test_loudness_of_a_tone(self) -> None:
        """1 kHz at full scale: -3 dB, and what the shelf adds there (1.2 dB)."""
        self.assertAlmostEqual(loudness(sine(1000.0, 22050)), -3.01 + 1.45, delta=0.1)


class Command(unittest.TestCase):
    def run_make(self, *arguments: str, **options) -> subprocess.CompletedProcess:
        command = [sys.executable, str(BASEGAME / "sounds" / "make.py"), *arguments]
        return subprocess.run(command, capture_output=True, text=True, check=False, **options)

    def test_list_names_every_sound_and_the_music(self) -> None:
        listed = self.run_make("--list").stdout.split()
        self.assertEqual(set(listed), {c.path for c in CONVENTIONS.values()} | set(tracks.PATHS))

    def test_bad_arguments_get_a_sentence(self) -> None:
        for arguments in (("--only", "no/such*"), ()):
            done = self.run_make(*arguments)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)

    def test_without_encoder_music_is_left_out(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            done = self.run_make("--out", folder, "--only", "music/track03.ogg", env={"PATH": folder})
            self.assertEqual(done.returncode, 0)
            self.assertIn("oggenc is missing", done.stderr)
            self.assertEqual(list(pathlib.Path(folder).rglob("*.ogg")), [])

    def test_only_what_is_asked_for(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(self.run_make("--out", folder, "--only", "*/menu?.wav").returncode, 0)
            self.assertEqual(
                sorted(p.name for p in pathlib.Path(folder).rglob("*.wav")), ["menu1.wav", "menu2.wav", "menu3.wav"]
            )


class Music(unittest.TestCase):
    def test_a_piece(self) -> None:
        """Stereo, at rest at both ends, within full scale, and as loud as music is to be."""
        piece = tracks.PIECES["track03"]()
        seconds = piece.shape[1] / 22050
        self.assertTrue(100 < seconds < 130, seconds)
        self.assertLess(np.max(np.abs(piece)), 0.9)
        self.assertLess(np.max(np.abs(piece[:, [0, -1]])), 0.001)
        self.assertLess(np.max(np.abs(np.mean(piece, axis=1))), 0.001)
        self.assertAlmostEqual(20 * np.log10(np.sqrt(np.mean(piece**2))), -20.0, delta=2.0)
        self.assertGreater(np.std(piece[0] - piece[1]), 0.1 * np.std(piece))


if __name__ == "__main__":
    unittest.main()
