#!/usr/bin/env python3
"""Tests of the benchmarks' own arithmetic, drawing and translation; nothing here measures anything."""
import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
from suite import error_fit, exr, fits, page, scenes, svg  # noqa: E402
from suite.context import check  # noqa: E402
from suite.peers import mitsuba_xml  # noqa: E402


class Fits(unittest.TestCase):
    def test_a_power_law_is_found_again(self):
        exponent, factor = fits.power_fit([1, 10, 100], [3, 3 * 10**1.5, 3 * 10**3])
        self.assertAlmostEqual(exponent, 1.5)
        self.assertAlmostEqual(factor, 3)

    def test_times_between_and_beyond_points_lie_on_the_line(self):
        points = [(1, 0.1), (4, 0.05), (5, 0.06), (16, 0.025)]  # the third is no better than the second
        for level, expected in ((0.1, 1), (0.0707106781, 2), (0.025, 16), (0.0125, 64), (0.2, 0.25)):
            self.assertAlmostEqual(fits.time_at(points, level) / expected, 1, places=6)
        self.assertIsNone(fits.time_at([(1, 0.1), (4, 0.1)], 0.05))

    def test_bias_and_variance_are_told_apart(self):
        found = error_fit.mean_square_fit([(t, 0.01**2 + 0.004 / t, 4) for t in (1, 4, 16, 64, 256)])
        self.assertAlmostEqual(found["bias"], 0.01)
        self.assertAlmostEqual(found["variance_seconds"], 0.004)
        self.assertLess(found["bias_low"], 0.01)
        self.assertGreater(found["bias_high"], 0.01)

    def test_checks_compare(self):
        self.assertTrue(check("a", 1.0, least=1)["holds"])
        self.assertFalse(check("a", 0.99, least=1)["holds"])
        self.assertFalse(check("a", 1.3, most=1.2)["holds"])
        self.assertFalse(check("a", None, most=1.2)["holds"])


class Drawing(unittest.TestCase):
    def test_plots_are_xml_and_hold_their_points(self):
        drawing = svg.lines("a < b", "x", "y", [("one & two", [(1, 0.1), (10, 0.01), (100, 0)]), ("none", [])])
        root = xml.fromstring(drawing)
        self.assertEqual(len([e for e in root.iter() if e.tag.endswith("circle")]), 2)
        bars = xml.fromstring(svg.bars("t", "y", [("g", [1.0, None, 0.2])], ["a", "b", "c"], line=1))
        self.assertEqual(len([e for e in bars.iter() if e.tag.endswith("rect")]), 3)

    def test_the_page_escapes_and_marks_what_was_missed(self):
        document = {"hardware": {"cores": 2}, "versions": {}, "started": "", "ended": "", "quick": True, "results": {}, "failed": {},
                    "checks": [check("fast <enough>", 0.5, least=1)]}
        text = page.render(document)
        self.assertIn("fast &lt;enough&gt;", text)
        self.assertIn('class="missed"', text)
        self.assertNotIn("http://", text.replace("http://www.w3.org/2000/svg", ""))


class Scenes(unittest.TestCase):
    def test_every_scene_of_the_comparison_is_translated(self):
        box = mitsuba_xml.read_scene(HERE.parent / "scenes/cornell-box/scene.xml")
        self.assertEqual(sum(len(m["faces"]) for m in box["meshes"]), 38)
        self.assertIn((17.0, 12.0, 4.0), [m["material"]["colour"] for m in box["meshes"]])
        self.assertEqual(mitsuba_xml.point(box["to_world"], (0, 0, 0)), (2.78, 2.73, -8.0))
        spheres = mitsuba_xml.read_scene(HERE.parent / "scenes/glass-and-metal/scene.xml")["spheres"]
        self.assertEqual([s["material"]["kind"] for s in spheres], ["glass", "metal"])
        self.assertEqual(box["max_depth"], 10)

    def test_textures_and_skies_are_translated(self):
        hall = mitsuba_xml.read_scene(HERE.parent / "scenes/sunlit/hall.xml")
        textures = [m["material"]["texture"] for m in hall["meshes"] if "texture" in m["material"]]
        self.assertEqual([sorted(t) for t in textures],
                         [["image", "to_uv"], ["colours", "to_uv"], ["image", "to_uv"]])
        self.assertEqual([t["to_uv"][0][0] for t in textures], [6, 10, 6])
        self.assertEqual(textures[1]["colours"], [(0.12, 0.25, 0.3), (0.75, 0.7, 0.6)])
        self.assertEqual(hall["envmap"]["scale"], 1.5)
        self.assertTrue(pathlib.Path(hall["envmap"]["image"]).is_file())
        self.assertEqual(hall["spheres"][1]["centre"], (0.9, 0.55, 0.6))

    def test_what_is_not_known_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            path = scenes.material_room(pathlib.Path(folder), "rough glass")
            with self.assertRaisesRegex(mitsuba_xml.Refused, "roughdielectric"):
                mitsuba_xml.read_scene(path)

    def test_lights_that_reflect_are_refused(self):
        with self.assertRaisesRegex(mitsuba_xml.Refused, "emit and reflect"):
            mitsuba_xml.read_scene(HERE.parent / "scenes/closed_form/enclosure_box/scene.xml")

    def test_made_scenes_are_xml(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for path in (scenes.many_materials(folder), scenes.many_lamps(folder, 10), scenes.hills(folder, 800),
                         scenes.textured_room(folder, 16)):
                xml.parse(path)
            mesh = (folder / "hills-800.ply").read_bytes()
            self.assertEqual(len(mesh.split(b"end_header\n", 1)[1]), 21 * 21 * 12 + 800 * 13)

    def test_a_constant_image_has_the_size_it_should(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "c.exr"
            exr.write_constant(path, 5, 3, (1, 2, 4))
            data = path.read_bytes()
            self.assertEqual(data[:4], b"\x76\x2f\x31\x01")
            self.assertTrue(data.endswith(b"\x00\x00\x80\x3f" * 5))


class CommandLine(unittest.TestCase):
    def test_wrong_arguments_are_one_line_and_exit_code_2(self):
        for wrong in (["nonsense"], ["--json"], ["build", "--threads", "many"], ["--no-such"]):
            run = subprocess.run([sys.executable, HERE / "bench.py", *wrong], capture_output=True, text=True,
                                 check=False)
            self.assertEqual(run.returncode, 2)
            self.assertEqual(len(run.stderr.strip().splitlines()), 1)
            self.assertEqual(run.stdout, "")


if __name__ == "__main__":
    unittest.main()
