"""Builds and runs the program of packaging/tests/consumer-cmake with the package that `conan create`
has just made.
"""

from pathlib import Path

from conan import ConanFile
from conan.tools.build import can_run
from conan.tools.cmake import CMake, CMakeToolchain, cmake_layout


class Consumer(ConanFile):
    settings = "os", "arch", "compiler", "build_type"
    languages = "C"

    def requirements(self):
        self.requires(self.tested_reference_str)

    def layout(self):
        if Path(self.recipe_folder, "CMakeLists.txt").exists():  # a recipe of a release
            return cmake_layout(self)
        # In the tree's build/, which git ignores.
        self.folders.root = "../../.."
        cmake_layout(
            self, src_folder="packaging/tests/consumer-cmake", build_folder="build/conan-consumer"
        )

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.user_presets_path = False
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def test(self):
        if can_run(self):
            for program in sorted(Path(self.cpp.build.bindir).glob("consumer*")):
                if program.is_file():
                    self.run(str(program.resolve()), env="conanrun")
