"""What the tests of `trismooth bench` have in common."""

import json

import tool


class BenchTest(tool.ToolTest):

    def bench(self, *arguments, **more):
        return self.run_tool("bench", *arguments, **more)

    def bench_report(self, *arguments, **more):
        """The JSON report of a run with these arguments."""
        self.bench(*arguments, "--report", "bench.json", **more)
        return json.loads(self.read("bench.json"))
