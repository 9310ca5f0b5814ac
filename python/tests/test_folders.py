"""The core loads none of the folders; the short names of their modules offer what these offer."""

import importlib
import importlib.util
import pickle

import pytest
from conftest import run_python

import carom

NEEDED = {"gymnasium": "gymnasium", "pettingzoo": "pettingzoo", "sb3": "stable_baselines3"}
ABSENT = [name for name, package in NEEDED.items() if not importlib.util.find_spec(package)]
MODULES = {
    f"carom.{name}": f"carom.{'tracks' if name == 'fit' else 'games'}.{name}"
    for name in sorted(carom._MODULES_OF_FOLDERS)
}
SHORT = [name for name in MODULES if name[6:] not in ABSENT]


def test_the_core_loads_no_folder():
    loaded = "print({'carom.tracks', 'carom.film', 'carom.games', 'carom.pooltool'} & sys.modules.keys())"
    assert run_python("-c", f"import carom, sys; {loaded}").stdout == "set()\n"
    assert (
        run_python("-c", f"import carom, sys; carom.plan; {loaded}").stdout == "{'carom.games'}\n"
    )


@pytest.mark.parametrize("first", ["import {short}", "from carom import {name}", "import carom"])
def test_a_short_name_offers_what_the_module_offers(first):
    """In a process where nothing is loaded yet, the very objects."""
    lines = ["import importlib"]
    for short in SHORT:
        lines.append(first.format(short=short, name=short[6:]))
        module = short[6:] if first.startswith("from") else short
        lines.append(f"long = importlib.import_module('{MODULES[short]}')")
        lines.append("assert long.__all__")
        lines.append("for name in long.__all__:")
        lines.append(f"    assert getattr({module}, name) is getattr(long, name), name")
        lines.append(f"assert importlib.reload({module}) is {module}")
    run_python("-c", "\n".join(lines))


def test_short_names_run_and_have_help():
    assert "--cushion-model" in run_python("-m", "carom.fit", "--help").stdout
    assert "fit(recordings" in run_python("-m", "pydoc", "carom.tracks.fit").stdout
    assert "carom.tracks.fit" in run_python("-m", "pydoc", "carom.fit").stdout
    assert "referee" in run_python("-m", "pydoc", "carom").stdout


def test_pickles_have_short_names_and_long_ones():
    foul = carom.Foul(0)
    assert pickle.loads(b"ccarom.rules\nFoul\n(I0\ntR.") is foul is pickle.loads(pickle.dumps(foul))


def test_a_name_that_is_not_there():
    assert not hasattr(carom, "plans_of") and not hasattr(carom, "_plans")
    with pytest.raises(ModuleNotFoundError, match="carom.fits"):
        importlib.import_module("carom.fits")


def test_gymnasium_knows_the_short_name():
    gymnasium = pytest.importorskip("gymnasium", reason="gymnasium is not installed")
    env = gymnasium.make("carom.gymnasium:carom/PotOne-v1")
    assert env.spec.entry_point == "carom.gymnasium:GameEnv"
    assert type(env.unwrapped) is importlib.import_module("carom.games.gymnasium").GameEnv


@pytest.mark.parametrize("package", ["gymnasium", "pettingzoo"])
def test_without_what_is_optional(package):
    """The import says what is needed."""
    absent = f"import sys; sys.modules['{package}'] = None; import carom.potting, carom.pool"
    message = run_python("-c", f"{absent}; import carom.{package}", status=1).stderr
    assert f"ImportError: carom.{package} needs" in message and f"pip install {package}" in message


def test_tab_completion_shows_what_a_module_of_a_folder_offers():
    private = {"Made", "judge", "of_record", "check_table", "np", "ffi", "lib", "Any", "pointer"}
    for module in map(importlib.import_module, ["carom.tracks", *SHORT]):
        shown = set(dir(module))
        assert shown and not private & shown, module
        assert set(getattr(module, "__all__", ())) <= shown, module
