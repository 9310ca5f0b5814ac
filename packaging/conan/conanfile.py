"""The Conan 2 recipe of the library, without the command: conan create packaging/conan packs the
tree; beside the conandata.yml of a release it packs the archive that this names.

A consumer finds what CMake installs: the targets carom::carom and, if the library is static,
carom::static. There is no option fPIC, as carom's CMake files compile all code
position-independent.
"""

import re
from pathlib import Path

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeToolchain, cmake_layout
from conan.tools.files import copy, get, load

TREE = "../.."


class Carom(ConanFile):
    name = "carom"
    description = "Collisions of billiard balls"
    license = "Apache-2.0"
    topics = ("physics", "simulation", "billiards")
    package_type = "library"
    languages = "C"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "threads": [True, False], "isas": ["ANY"]}
    default_options = {"shared": False, "threads": True, "isas": "all"}

    def set_version(self):
        if self.conan_data:
            self.version = next(iter(self.conan_data["sources"]))
            return
        # The version has one source, the public header.
        header = load(self, Path(self.recipe_folder, TREE, "core/include/carom.h"))
        self.version = ".".join(
            re.search(rf"^#define CAROM_VERSION_{part} (\d+)$", header, re.M)[1]
            for part in ("MAJOR", "MINOR", "PATCH")
        )

    def export_sources(self):
        if self.conan_data:
            return
        for part in (
            "CMakeLists.txt",
            "LICENSE",
            "NOTICE",
            "cmake/*",
            "core/CMakeLists.txt",
            "core/include/*",
            "core/src/*",
            "games/CMakeLists.txt",
            "games/include/*",
            "games/rules/*",
            "games/ratings/*",
            "games/search/*",
            "games/coach/*",
            "games/match/*",
            "bindings/cpp/*",
        ):
            copy(self, part, Path(self.recipe_folder, TREE), self.export_sources_folder)

    def source(self):
        if self.conan_data:
            get(self, **self.conan_data["sources"][self.version], strip_root=True)

    def layout(self):
        self.folders.root = None if self.conan_data else TREE
        cmake_layout(self, build_folder="build/conan")

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.user_presets_path = False
        toolchain.cache_variables["CAROM_CLI"] = False
        toolchain.cache_variables["CAROM_THREADS"] = bool(self.options.threads)
        toolchain.cache_variables["CAROM_ISAS"] = str(self.options.isas)
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        for name in ("LICENSE", "NOTICE"):
            copy(self, name, self.source_folder, Path(self.package_folder, "licenses"))

    def package_info(self):
        # CMake uses the installed package; the rest is for consumers that use other build systems.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = ["lib/cmake/carom"]
        self.cpp_info.libs = ["carom"]
        if self.settings.os == "Windows":
            self.cpp_info.defines = ["CAROM_DLL"] if self.options.shared else []
        else:
            self.cpp_info.system_libs = ["m", "pthread"] if self.options.threads else ["m"]
