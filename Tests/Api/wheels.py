# SPDX-License-Identifier: MIT
"""The wheel: it holds what the library needs, its tag says what its symbols ask for, and it works where it is unpacked. wheels.py ROOT LIBRARY."""
import importlib.util
import subprocess
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path

root, library = Path(sys.argv[1]), Path(sys.argv[2])
spec = importlib.util.spec_from_file_location("wheel_of_physvib", root / "Source/Api/Python/wheel.py")
wheel = importlib.util.module_from_spec(spec)
spec.loader.exec_module(wheel)


class Wheel(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_the_tag_is_that_of_the_newest_symbol(self) -> None:
        source = self.folder / "old.c"
        source.write_text("int nothing(void) { return 0; }\n")
        plain = self.folder / "libold.so"
        subprocess.run(["cc", "-shared", "-nostdlib", "-o", plain, source], check=True)
        self.assertEqual(wheel.glibc_of(plain), (2, 17))
        source.write_text("#include <iostream>\nvoid say() { std::cout << 1; }\n")
        newer = self.folder / "libnew.so"
        subprocess.run(["c++", "-x", "c++", "-shared", "-fPIC", "-o", newer, source], check=True)
        self.assertGreaterEqual(wheel.glibc_of(newer), (2, 17))
        symbols = wheel.output("objdump", "-T", str(library))
        asked = max(wheel.version_of(v) for v in wheel.re.findall(r"GLIBC_([0-9.]+)", symbols))
        self.assertGreaterEqual(wheel.glibc_of(library), asked[:2])

    def test_it_works_where_it_is_unpacked(self) -> None:
        made = wheel.make(library, self.folder)
        self.assertRegex(made.name, r"^physvib-[0-9.]+(rc[0-9]+)?-py3-none-manylinux_2_[0-9]+_[a-z0-9_]+\.whl$")
        with zipfile.ZipFile(made) as archive:
            names = archive.namelist()
            archive.extractall(self.folder / "here")
        subprocess.run([sys.executable, root / "Standalone/Packaging/sbom.py", "--opened", made], check=True)
        for name in wheel.needed(library):
            self.assertIn(f"physvib/{name}", names)
        code = "import physvib; print(physvib.render(physvib.events(0.0, frequency_hz=200, decay_per_s=30), 0.1).shape, physvib._library.library.path)"
        said = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True, env={"PYTHONPATH": str(self.folder / "here")}).stdout
        self.assertTrue(said.startswith("(4, 4800) " + str(self.folder / "here")), said)


unittest.main(argv=sys.argv[:1])
