"""carom.torch: values are those of shots, gradients those of carom.tangents and of differences;
batches, errors.
"""

import numpy as np
import pytest

import carom

torch = pytest.importorskip("torch", reason="PyTorch is not installed")

import carom.torch  # noqa: E402

TABLE = carom.tables.pool_9ft()
BALLS = carom.balls([[0.4, 0.5], [0.6, 1.5], [0.9, 2.0]])
CUE = carom.cue(speed=1.5, phi=79.0, a=0.1, b=0.1)
CLOSED = {"ball_model": "inelastic", "cushion_model": "smooth"}
NAMES = ("cue.speed", "cue.phi", "cue.a", "cue.b")
AIM = torch.tensor([1.5, 79.0, 0.1, 0.1], dtype=torch.float64)


def ends(aim, **models):
    return carom.torch.final(TABLE, BALLS, CUE, dict(zip(NAMES, aim.unbind(-1))), **models)


def played(aim, **models):
    return carom.simulate(
        TABLE, BALLS, carom.cue(**dict(zip(("speed", "phi", "a", "b"), map(float, aim)))), **models
    )


@pytest.mark.parametrize("models", [{}, CLOSED, {"t_final": 0.9}])
def test_values_are_those_of_shots_and_jacobians_those_of_tangents(models):
    shot = played(AIM, **models)
    tangents, found = carom.tangents(shot, NAMES), ends(AIM, **models)
    for name, numbers in (("r", 2), ("v", 2), ("w", 3)):
        assert np.array_equal(getattr(found, name).numpy(), shot.final[name][:, :numbers])
        expected = tangents.final[name]
        jacobian = torch.autograd.functional.jacobian(
            lambda aim: getattr(ends(aim, **models), name), AIM
        )
        np.testing.assert_allclose(
            jacobian.numpy(), expected, rtol=1e-13, atol=1e-13 * np.abs(expected).max()
        )


def test_gradients_are_differences_of_shots():
    # closed models, as steps of the exact one change differences by 1e-4
    scales = torch.tensor([1.0, 1.0, 0.1, 0.1], dtype=torch.float64)
    x = (AIM / scales).requires_grad_()
    function = lambda arguments: ends(arguments * scales, **CLOSED).r  # noqa: E731
    assert torch.autograd.gradcheck(function, x, eps=1e-6, atol=1e-6, rtol=1e-6)
    # float32 and lists are converted, and the gradient of a float32 tensor is float32
    single = torch.tensor(1.5, requires_grad=True)
    carom.torch.final(TABLE, BALLS, CUE, {"cue.speed": single}).r[1].sum().backward()
    assert single.grad.dtype == torch.float32
    assert float(single.grad) == pytest.approx(
        carom.tangents(played(AIM), ["cue.speed"]).final["r"][1].sum(), rel=1e-6
    )


def test_batches_are_broadcast_and_have_the_bits_of_single_shots():
    layouts = carom.balls(
        [[[0.4, 0.5], [0.6, 1.5]], [[0.4, 0.6], [0.62, 1.4]], [[0.45, 0.5], [0.63, 1.45]]]
    )
    cues = carom.cue(speed=[[1.5], [1.9]], phi=79.0, b=0.1)
    phi = torch.linspace(78.5, 79.5, 6, dtype=torch.float64).reshape(2, 3).requires_grad_()
    places = torch.tensor(layouts["state"]["r"][:, 1, :2], requires_grad=True)
    found = carom.torch.final(TABLE, layouts, cues, {"cue.phi": phi, "balls[1].r": places})
    found.r.sum().backward()
    assert found.r.shape == (2, 3, 2, 2)
    slopes = np.zeros((3, 2))
    for i, j in np.ndindex(2, 3):
        cue = cues[i, 0].copy()
        cue["phi"] = float(phi[i, j])
        shot = carom.simulate(TABLE, layouts[j], cue)
        assert np.array_equal(found.r[i, j].detach().numpy(), shot.final["r"][:, :2])
        tangents = carom.tangents(shot, ["cue.phi", "balls[1].r"]).final["r"].sum(axis=(0, 1))
        assert float(phi.grad[i, j]) == pytest.approx(tangents[0], rel=1e-12)
        slopes[j] += tangents[1:]
    np.testing.assert_allclose(places.grad.numpy(), slopes, rtol=1e-12)


def test_reach_and_flags_are_outputs_without_gradient():
    expected = carom.tangents(played(AIM), NAMES)
    aim = AIM.clone().requires_grad_()
    for start in (AIM, aim):
        found = ends(start, reach=True)
        reach = torch.stack([found.reach[name] for name in NAMES])
        assert np.array_equal(reach.numpy(), expected.reach) and not reach.requires_grad
        assert int(found.flags) == np.bitwise_or.reduce(expected.flags)
    slope, plain = (
        torch.autograd.grad(ends(aim, reach=has_reach).r[1].sum(), aim)[0]
        for has_reach in (True, False)
    )
    assert torch.equal(slope, plain)
    many = ends(torch.stack([AIM, AIM + 0.01]), reach=True)
    assert many.reach["cue.phi"].shape == many.flags.shape == (2,)
    assert ends(AIM).reach is None
    if hasattr(torch, "func"):
        mapped = torch.func.vmap(lambda aim: ends(aim, reach=True).reach["cue.phi"])
        assert torch.equal(mapped(torch.stack([AIM, AIM + 0.01])), many.reach["cue.phi"])
        jacobian = torch.func.jacrev(lambda aim: ends(aim, reach=True).r[1])(AIM)
        assert torch.equal(jacobian, torch.func.jacrev(lambda aim: ends(aim).r[1])(AIM))


def test_shots_that_are_refused_say_why():
    invalid = AIM.clone()
    invalid[3] = 2.0
    for numbers in (invalid, invalid.clone().requires_grad_()):
        with pytest.raises(
            carom.CaromError,
            match=r"cue\.speed = 1\.5, cue\.phi = 79, cue\.a = 0\.1, cue\.b = 2: .*must be -1 to 1",
        ):
            ends(numbers)
    both = torch.stack([AIM, invalid]).requires_grad_()
    found = ends(both, errors="nan").r
    found[0].sum().backward()
    assert (
        torch.isfinite(found[0]).all()
        and torch.isnan(found[1]).all()
        and torch.isfinite(both.grad[0]).all()
    )
    with pytest.raises(
        ValueError, match=r"numbers: balls\[1\]\.r: the shape must be \(\.\.\., 2\), not \(3,\)"
    ):
        carom.torch.final(TABLE, BALLS, CUE, {"balls[1].r": torch.ones(3)})


def test_second_derivatives_are_those_of_hessian():
    goal = torch.tensor([0.6, 1.0], dtype=torch.float64)
    miss = lambda aim: ((ends(aim).r[..., 1, :] - goal) ** 2).sum(-1)  # noqa: E731
    shot = played(AIM)
    found, off = carom.hessian(shot, NAMES), shot.final["r"][1, :2] - goal.numpy()
    first = found.first.final["r"][1]
    expected = 2.0 * (first.T @ first + np.einsum("i,ijk->jk", off, found.final["r"][1]))

    def close(found, rtol=1e-09):
        return np.testing.assert_allclose(found.detach().numpy(), expected, rtol=rtol, atol=rtol)  # noqa: E731

    close(torch.autograd.functional.hessian(miss, AIM))
    aim = AIM.clone().requires_grad_()
    (slope,) = torch.autograd.grad(miss(aim), aim, create_graph=True)
    (second,) = torch.autograd.grad(slope[0], aim, create_graph=True)
    close(torch.stack([second, *second.new_tensor(expected[1:])]))
    with pytest.raises(
        (NotImplementedError, RuntimeError), match="third derivatives of shots are not known"
    ):
        torch.autograd.grad(second.sum(), aim)
    if not hasattr(torch, "func"):
        return
    func, aims = torch.func, torch.stack([AIM + 0.01, AIM])
    slopes, (hessian, rev, fwd) = (
        expected @ [1.0, 0.1, 1.0, 1.0],
        (func.hessian, func.jacrev, func.jacfwd),
    )
    for second in (
        hessian(miss)(AIM),
        rev(rev(miss))(AIM),
        rev(fwd(miss))(AIM),
        func.vmap(hessian(miss))(aims)[1],
    ):
        close(second)
    # Along one vector the product alone is found, by differences of its own.
    along = func.jvp(func.grad(miss), (AIM,), (AIM.new_tensor([1.0, 0.1, 1.0, 1.0]),))
    np.testing.assert_allclose(along[0], 2.0 * off @ first, rtol=1e-12)
    np.testing.assert_allclose(along[1], slopes, rtol=2e-5)
    with pytest.raises(NotImplementedError, match="third derivatives of shots"):
        rev(hessian(miss))(AIM)
    with pytest.raises(NotImplementedError, match="forward mode of forward mode"):
        fwd(fwd(miss))(AIM)


@pytest.mark.skipif(not hasattr(torch, "func"), reason="PyTorch is older than 2.0")
def test_functions_of_torch_func(monkeypatch):
    """vmap is one batch, and each transformation has the derivatives of tangents; so has compiled
    code.
    """
    played_at, func = [], torch.func
    simulate, total = carom.derivatives.simulate_batch, lambda aim: ends(aim).r.sum((-1, -2))
    monkeypatch.setattr(
        carom.derivatives,
        "simulate_batch",
        lambda *arguments, **more: played_at.append(1) or simulate(*arguments, **more),
    )
    aims = AIM + torch.linspace(0.0, 0.1, 5, dtype=torch.float64)[:, None]
    singly = np.stack([carom.tangents(played(aim), NAMES).final["r"].sum((0, 1)) for aim in aims])
    for slopes in (
        func.vmap(func.grad(total)),
        func.vmap(func.jacrev(total)),
        func.vmap(func.jacfwd(total)),
        func.grad(lambda x: func.vmap(total)(x).sum()),
    ):
        played_at.clear()
        np.testing.assert_allclose(slopes(aims), singly, rtol=1e-11)
        assert len(played_at) == 1
    # one number is mapped, one is not; nested
    speeds, phis = aims[:3, 0], aims[:2, 1]
    grid = func.vmap(
        func.vmap(lambda s, p: total(torch.stack([s, p, AIM[2], AIM[3]])), (None, 0)), (0, None)
    )(speeds, phis)
    assert float(grid[2, 1]) == pytest.approx(
        float(total(torch.stack([speeds[2], phis[1], AIM[2], AIM[3]]))), rel=1e-13
    )
    try:
        compiled = torch.compile(total, backend="eager")
    except RuntimeError as error:
        pytest.skip(str(error))  # of a Python that is too new
    aim = AIM.clone().requires_grad_()
    value = compiled(aim)
    value.backward()
    assert float(value) == pytest.approx(float(total(AIM)), rel=1e-13)
    np.testing.assert_allclose(aim.grad, singly[0], rtol=1e-11)


def test_clusters_banks_and_raised_strikes():
    """300 shots in one batch have the derivatives of tangents: strikes into three balls that touch,
    off a rail, and with a raised cue.
    """
    rack, random = (
        [[0.635, 1.5], [0.635 + 0.05715, 1.5], [0.635 + 0.028575, 1.5 + 0.0494934]],
        np.random.default_rng(1),
    )
    cues = carom.cue(
        speed=random.uniform(2.0, 3.0, 300),
        phi=[88.0, 20.0, 85.0] * 100 + random.normal(0.0, 1.0, 300),
        theta=[0.0, 0.0, 30.0] * 100,
        b=0.1,
    )
    names, balls = ["cue.speed", "cue.phi", "cue.theta", "cue.b"], carom.balls([[0.6, 0.5], *rack])
    numbers = [torch.tensor(cues[name[4:]].copy(), requires_grad=True) for name in names]
    carom.torch.final(TABLE, balls, cues, dict(zip(names, numbers))).r.sum().backward()
    for k, cue in enumerate(cues):
        expected = carom.tangents(carom.simulate(TABLE, balls, cue), names).final["r"].sum((0, 1))
        np.testing.assert_allclose(
            [each.grad[k] for each in numbers],
            expected,
            rtol=0.0,
            atol=1e-9 * np.abs(expected).max(),
        )
