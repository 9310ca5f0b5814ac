"""Names of modules as pages use them: mypy --strict knows each, and what it gives."""

import carom
import carom.drills
import carom.fit
import carom.gymnasium
import carom.matches
import carom.pettingzoo
import carom.plans
import carom.pool
import carom.potting
import carom.rules
import carom.sb3
from carom.pettingzoo import PoolEnv
from carom.pool import Pool

rules: Pool = Pool("nineball", cushion_model="han")
same_rules: carom.pool.Pool = rules
rating: carom.Rating = carom.plans.rating([(1.0, 500.0)])
same: carom.plans.Rating = rating
entry: type[PoolEnv] = carom.pettingzoo.PoolEnv
ruling: type[carom.Ruling] = carom.rules.Ruling
run = carom.fit.main
game: carom.potting.Potting = carom.drills.ThreeCushion()
match: type[carom.matches.Match] = carom.matches.Match
env: type[carom.gymnasium.GameEnv] = carom.gymnasium.GameEnv
games: type[carom.sb3.VecGames] = carom.sb3.VecGames
