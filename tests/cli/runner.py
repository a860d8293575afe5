"""Runs the command line tool for the tests beside this file."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop(1)


def run(*arguments, stdin=None):
    """Exit code, stdout and stderr of one call."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], input=stdin, capture_output=True, text=True, timeout=300)
    return done.returncode, done.stdout, done.stderr


class Case(unittest.TestCase):
    """A test with a directory of its own."""

    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = pathlib.Path(directory.name)

    def file(self, name, text):
        path = self.directory / name
        path.write_text(text)
        return path

    def generate(self, name, *arguments):
        path = self.directory / name
        code, _, errors = run("generate", *arguments, "--out", path)
        self.assertEqual(code, 0, errors)
        return path

    def json(self, *arguments, code=0, stdin=None):
        found, out, errors = run(*arguments, "--json", stdin=stdin)
        self.assertEqual(found, code, out + errors)
        return json.loads(out)


def main():
    unittest.main(verbosity=1)
