# SPDX-License-Identifier: MIT
"""What the applications beside it share: physvib play of a scene where nothing happens, which takes messages and answers queries."""
import json
import os
import subprocess
import sys

PROGRAM = os.environ.get("PHYSVIB", "physvib")


class Player:
    def __init__(self, *options):
        scene = os.path.join(os.path.dirname(os.path.abspath(__file__)), "quiet.json")
        self.process = subprocess.Popen([PROGRAM, "play", scene, "--listen", *options], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def say(self, message, **values):
        self.process.stdin.write(json.dumps({"message": message, **values}) + "\n")
        self.process.stdin.flush()

    def ask(self, query):
        self.say(query)
        for line in self.process.stdout:
            if line.startswith('{ "answer"'):
                return json.loads(line)
        sys.exit("physvib has ended")
