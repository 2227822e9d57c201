# SPDX-License-Identifier: BSD-3-Clause
"""What the films of a page show: every frame, what never moves told apart, and what flows in later not there before."""

import io
import sys
import unittest
from pathlib import Path

import numpy as np
from PIL import Image

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "reports"))
import animation


class Films(unittest.TestCase):
    def setUp(self):
        position = np.zeros((3, 4, 3))
        position[:, :, 0] = [0.0, 1.0, 2.0, 3.0]
        position[:, 0, 1] = 1.0  # behind, and never moves
        position[:, 1, 2] = [0.0, -1.0, -2.0]  # falls
        position[:2, 2] = np.nan  # flows in at the end
        position[:, 3, 2] = 3.0  # in front, and never moves
        phase = np.array([[2, 0, 0, 1]] * 3)
        phase[2, 1] = 2  # freezes
        self.places, self.kinds, self.height, self.diameter = animation.seen(
            position, phase, np.array([[0, 1, 2, 0]] * 3)
        )

    def test_the_half_in_front_of_what_never_moves_is_left_out(self):
        self.assertEqual(self.kinds.shape, (3, 3))

    def test_kinds_follow_the_phase_and_what_is_not_there_yet_is_not_drawn(self):
        self.assertEqual(sorted(map(tuple, self.kinds.T.tolist())), [(0, 0, 2), (1, 1, 4), (5, 5, 5)])

    def test_what_falls_goes_down_the_picture_evenly_and_stays_inside(self):
        heights = self.places[:, self.kinds.T.tolist().index([1, 1, 4]), 1]
        self.assertLess(heights[0], heights[1])
        self.assertAlmostEqual(heights[2] - heights[1], heights[1] - heights[0], places=12)
        self.assertLess(heights[2] + 0.5 * self.diameter, self.height + 1e-12)

    def test_the_picture_has_every_frame_and_shows_the_freezing(self):
        picture = Image.open(io.BytesIO(animation.painted(self.places, self.kinds, self.height, 0.2)))
        self.assertEqual(picture.n_frames, 3)
        falls = self.kinds.T.tolist().index([1, 1, 4])
        for frame, colour in ((0, animation.COLOURS[1]), (2, animation.COLOURS[4])):
            picture.seek(frame)
            x, y = (self.places[frame, falls] * animation.WIDTH).astype(int)
            self.assertEqual(picture.convert("RGB").getpixel((int(x), int(y))), colour)

    def test_a_case_that_was_not_run_says_so(self):
        class Results:
            cases = ()

        self.assertIn("not among these results", animation.film(Results(), "paper/fig-12", "a film").note)


if __name__ == "__main__":
    unittest.main()
