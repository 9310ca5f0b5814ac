"""The options of whole shots, by their names. A new one stands in `Options`, in `Changes` for type checkers, and in `shot_options`."""

from __future__ import annotations

import reprlib
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypedDict

import numpy as np

from carom._carom import ffi
from carom._described import BallFriction
from carom._described import BallModel as BallModel
from carom._described import ShotCushion as ShotCushion
from carom._described import Simultaneous as Simultaneous
from carom._described import Space as Space
from carom._described import World as World
from carom._rows import cached, choice, number, numbered, several, whole

Friction = BallFriction
StopAt = Literal[
    "contact", "strike", "ball_ball", "rail", "jaw", "pocket", "sliding_rolling", "rolling_spinning", "rolling_stationary",
    "spinning_stationary", "slate", "rail_top", "left_table",
]  # fmt: skip
_WORLDS, _BALL_MODELS, _CUSHIONS = numbered("carom_world"), numbered("carom_ball_model"), numbered("carom_shot_cushion")
_FRICTIONS, _SPACES, _SIMULTANEOUS = numbered("carom_ball_friction"), numbered("carom_space"), numbered("carom_simultaneous")
# CAROM_STOP_AT_CONTACT, and CAROM_STOP_AT() of the values of carom_event_type.
_STOPS = {"contact": 0, **numbered("carom_event_type")}


class Options(NamedTuple):
    """By what a shot is played. `carom.simulate` takes these names as keywords, or an object of this class, or both.

    Attributes
    ----------
    world : {"carom", "pooltool"}
        The rules of contact: carom's, or pooltool's, which give the histories of pooltool.
    ball_model : {"default", "exact", "euler", "inelastic", "mirror"}
        Model of the collision of two balls. Default: exact in the world carom, inelastic in pooltool.
    cushion_model : {"default", "mathavan", "stronge", "han", "mirror", "euler", "smooth"}
        Model of the impact on a cushion. Default: smooth for balls with its numbers, as those of billiard, else han; stronge in the
        world pooltool. mathavan is the exact limit, and takes most of the time.
    friction : {"alciatore", "constant"}
        Between balls: by the speed of slip, or the balls' mu_ball.
    space : {"3d", "flat"}
        Whether balls can leave the cloth, as by an elevated cue. The world pooltool is flat.
    simultaneous : {"cluster", "pairs"}
        Contacts of several balls at one instant, as in a rack: they last and overlap in time, or they are resolved one after the other. The world
        pooltool and the ball models euler and inelastic have pairs.
    cluster_steps : int
        Of the integrator of clusters, for the duration of a contact, at most 10000; 0 is 25.
    steps : int
        Of Euler's models; 0 is 1000.
    events_most : int
        Bound of events; 0 is 10000.
    plain : bool
        Whether this call computes with the instruction set plain, as with CAROM_ISA=plain: it has the bits that all machines share.
    t_final : float, optional
        The shot is stopped at exactly this time, s, with the status STOPPED_AT_TIME if balls still move. Without it a shot that
        lasts longer than 1000 s is an error.
    stop_at : str or tuple of str
        The shot is stopped after the first event of these, with the status STOPPED_AT_EVENT: "contact", of the cue ball with
        another, or a type of `carom.EventType` in lower case, such as "pocket". `carom.resume` goes on with a shot that was stopped.
    first_of : int or tuple of int
        Indices of balls. The shot is stopped right after the first contact of the cue ball with another ball, with the status
        STOPPED_AT_EVENT, unless that ball is one of these. (): it is not stopped.
    """

    world: World = "carom"
    ball_model: BallModel = "default"
    cushion_model: ShotCushion = "default"
    friction: Friction = "alciatore"
    space: Space = "3d"
    simultaneous: Simultaneous = "cluster"
    cluster_steps: int = 0
    steps: int = 0
    events_most: int = 0
    plain: bool = False
    t_final: float | None = None
    stop_at: StopAt | Iterable[StopAt] = ()
    first_of: int | Iterable[int] = ()

    def changed(self, changes: Any) -> Options:
        """These options but for some, by their names."""
        unknown = changes.keys() - set(self._fields)
        if unknown:
            raise TypeError(f"options: there is no {min(unknown)!r}; known are {', '.join(self._fields)}")
        made = self._replace(**changes)
        if not isinstance(made.first_of, (int, tuple)):
            balls = several(made.first_of, "first_of", "the index of a ball is needed, or several")
            made = made._replace(first_of=tuple(whole(ball, "first_of", most=31) for ball in balls))
        if not isinstance(made.stop_at, (str, tuple)):
            made = made._replace(stop_at=tuple(several(made.stop_at, "stop_at", "the name of an event is needed, or several")))
        return made


if TYPE_CHECKING:

    class Changes(TypedDict, total=False):
        """Some of the options, as keywords."""

        world: World
        ball_model: BallModel
        cushion_model: ShotCushion
        friction: Friction
        space: Space
        simultaneous: Simultaneous
        cluster_steps: int
        steps: int
        events_most: int
        plain: bool
        t_final: float | None
        stop_at: StopAt | Iterable[StopAt]
        first_of: int | Iterable[int]


def chosen(options: object, changes: Any) -> Options:
    """The argument `options` with single options; what is no Options is refused."""
    if not isinstance(options, Options):
        raise TypeError(
            f"options: a carom.Options is needed, such as carom.Options(world='pooltool'), not {reprlib.repr(options)}; "
            "single options are keywords of their own: world='pooltool'"
        )
    return options.changed(changes)


@cached
def shot_options(given: Options, threads: int = 0) -> Any:
    """The options of C; they are never written to."""
    (world, ball_model, cushion_model, friction, space, simultaneous, cluster_steps, steps, events_most, plain, t_final, stop_at,
     first_of) = given  # fmt: skip
    if t_final is not None and not 0.0 < (t_final := number(t_final, "t_final", "a time in s is needed, or None")) < np.inf:
        raise ValueError(f"t_final: it must be positive and finite, in s, or None, not {t_final:g}")
    stops = (stop_at,) if isinstance(stop_at, str) else tuple(stop_at)
    balls = (first_of,) if isinstance(first_of, int) else tuple(first_of)
    named = {
        "world": choice(_WORLDS, world, "world"), "ball_model": choice(_BALL_MODELS, ball_model, "ball_model"),
        "cushion_model": choice(_CUSHIONS, cushion_model, "cushion_model"), "friction": choice(_FRICTIONS, friction, "friction"),
        "simultaneous": choice(_SIMULTANEOUS, simultaneous, "simultaneous"),
        "space": choice(_SPACES, space, "space"), "stop_at": sum({1 << choice(_STOPS, stop, "stop_at") for stop in stops}),
        "first_of": sum({1 << whole(ball, "first_of", most=31) for ball in balls}),
    }  # fmt: skip
    numbers = {"steps": whole(steps, "steps"), "events_most": whole(events_most, "events_most"), "plain": whole(plain, "plain", most=1)}
    numbers["cluster_steps"] = whole(cluster_steps, "cluster_steps", most=10000)
    numbers["threads"] = whole(threads, "threads", least=-1)
    return ffi.new("carom_shot_options *", {**named, **numbers, "time_most": t_final or 0.0})
