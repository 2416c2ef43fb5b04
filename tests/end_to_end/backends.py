# SPDX-License-Identifier: BSD-3-Clause
"""Who runs the sweeps: what is said where there is no device, what auto takes, and the same bits from all of them.

A test that needs a device, or needs that there is none, is skipped elsewhere and says so.
"""

import itertools
import json
import re

import sample_meshes
import tool

WRONG_USAGE, NO_DEVICE = 2, 5


class BackendTest(tool.ToolTest):

    def setUp(self):
        super().setUp()
        self.write("plate.off", sample_meshes.off(sample_meshes.Grid()))
        self.info = re.sub(r"\n +", " ", self.run_tool("info").out)  # without the breaks of long lines
        self.is_built = not re.search(r"^CUDA: +not in this build$", self.info, re.M)
        self.has_device = bool(re.search(r"^device 0: ", self.info, re.M))
        self.has_cdp = bool(re.search(r"^CUDA: .*, with dynamic parallelism", self.info, re.M))

    def require_device(self):
        if not self.has_device:
            self.skipTest("there is no CUDA device")

    def require_built(self):
        if not self.is_built:
            self.skipTest("this build has no CUDA")

    def executions(self):
        return ["resident", "single-block"] + ["cdp"] * self.has_cdp


class Availability(BackendTest):

    def test_info_says_what_cuda_there_is(self):
        self.require_built()
        self.assertRegex(self.info, r"(?m)^CUDA: +runtime \d+\.\d, (no driver|driver for \d+\.\d), with(out)? dynamic")
        if self.has_device:
            self.assertRegex(self.info,
                             r"(?m)^device 0: +\S.*, compute capability \d+\.\d, \S+ [GM]iB \(\S+ [GM]iB "
                             r"free\), \d+ multiprocessors$")
        else:
            self.assertRegex(self.info, r"(?m)^no device: +cudaError\w+ \(")

    def test_a_driver_that_shows_no_device_stops_cuda_and_not_the_cpu(self):
        self.require_built()
        hidden = {"CUDA_VISIBLE_DEVICES": ""}
        self.assertRegex(self.run_tool("info", environment=hidden).out, r"(?m)^no device: +cudaError\w+ \(")
        outcome = self.run_tool("smooth", "plate.off", "out.off", "--backend", "cuda", expect=NO_DEVICE,
                                environment=hidden)
        self.assertRegex(outcome.err, r"cudaError\w+")
        self.run_tool("smooth", "plate.off", "out.off", environment=hidden)


class Auto(BackendTest):

    def test_auto_smooths_a_small_mesh_on_the_cpu_without_a_word(self):
        for more in ((), ("--execution", "cdp", "--layout", "soa"), ("--topology", "device")):
            with self.subTest(more):
                report = self.report("smooth", "plate.off", "out.off", *more)
                self.assertEqual(report["options"]["backend"], "cpu")
                self.assertIsNone(report["smoothing"]["backend_note"])
                self.assertEqual(report["smoothing"]["kernel_launches"], 0)

    def test_auto_takes_a_device_for_a_large_mesh_and_says_why_where_there_is_none(self):
        self.require_built()
        large = int(re.search(r"(\d+)\s+vertices\s+or\s+more\s+are\s+free", self.run_tool("smooth", "--help").out)[1])
        # The boundary is not free, and is fine enough to be quiet.
        self.run_tool("generate", "large.vtu", "--vertices", large + large // 10, "--boundary", "resolved")
        arguments = ("smooth", "large.vtu", "out.vtu", "--max-sweeps", "2")
        outcome = self.run_tool(*arguments, "--topology", "device", "--report", "auto.json")
        self.assertEqual(outcome.err, "")
        report = json.loads(self.read("auto.json"))
        self.assertGreaterEqual(report["input"]["free_vertices"], large)
        self.assertEqual(report["options"]["backend"], "cuda" if self.has_device else "cpu")
        if self.has_device:
            self.assertIsNone(report["smoothing"]["backend_note"])
            self.assertGreater(report["smoothing"]["kernel_launches"], 0)
        else:
            note = report["smoothing"]["backend_note"]
            self.assertRegex(note, r"^no CUDA device: cudaError\w+")
            self.assertIn(note, " ".join(outcome.out.split()))
        self.assertEqual(report["coordinates_hash"],
                         self.report(*arguments, "--backend", "cpu")["coordinates_hash"])


class OnADevice(BackendTest):

    def setUp(self):
        super().setUp()
        self.require_device()
        self.run_tool("generate", "random.off", "--vertices", "3000", "--seed", "4")

    def test_every_execution_layout_and_topology_gives_the_bits_of_the_cpu(self):
        for method, form, precision in itertools.product(self.methods(), "ab", ("double", "single")):
            what = ("smooth", "random.off", "out.off", "--method", method, "--form", form, "--precision", precision,
                    "--max-sweeps", "40")
            expected = self.report(*what, "--backend", "cpu")
            ways = [("resident", "aos")]
            if method in ("smart", "laplacian"):
                ways += itertools.product(self.executions()[1:], ("aos", "soa"))
            for (execution, layout), topology in itertools.product(ways, ("host", "device")):
                with self.subTest(method=method, form=form, precision=precision, execution=execution, layout=layout,
                                  topology=topology):
                    report = self.report(*what, "--backend", "cuda", "--execution", execution, "--layout", layout,
                                         "--topology", topology)
                    self.assertEqual(report["options"]["backend"], "cuda")
                    for key in ("coordinates_hash", "uncommitted_hash", "input", "after"):
                        self.assertEqual(report[key], expected[key], key)
                    for key in ("sweeps", "stop_reason", "moved_vertices", "reverted_vertices", "reproducible"):
                        self.assertEqual(report["smoothing"][key], expected["smoothing"][key], key)
                    self.assertGreater(report["smoothing"]["kernel_launches"], 0)
                    self.assertEqual(report["smoothing"]["child_launches"] > 0, execution == "cdp")
                    self.assertGreater(report["smoothing"]["device_memory_bytes"], 0)

    def test_an_unordered_run_is_told_in_every_report(self):
        for execution in self.executions()[1:]:
            with self.subTest(execution):
                outcome = self.run_tool("smooth", "random.off", "out.off", "--order", "unordered", "--execution",
                                        execution, "--report", "run.json", "--report", "run.html")
                self.assertIn("unordered", outcome.out)
                self.assertIn("another run", outcome.out)
                report = json.loads(self.read("run.json"))
                self.assertEqual(report["options"]["backend"], "cuda")
                self.assertIs(report["smoothing"]["reproducible"], False)
                self.assertEqual(report["after"]["inverted"], 0)
                self.assertIn("Not reproducible", self.read("run.html").decode())


if __name__ == "__main__":
    tool.main()
