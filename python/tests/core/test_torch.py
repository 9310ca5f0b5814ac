"""carom.torch: values are those of shots, gradients those of carom.tangents and of differences;
batches, errors.
"""

from types import SimpleNamespace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import carom

torch = pytest.importorskip("torch", reason="PyTorch is not installed")

import carom.torch  # noqa: E402

from gradient_cases import *  # noqa: E402, F403
from gradient_cases import (  # noqa: E402
    BALLS,
    CLOSED,
    CUE,
    GOAL,
    NAMES,
    STROKE,
    TABLE,
    hessian_of_a_miss,
    played,
)

AIM = torch.tensor(STROKE, dtype=torch.float64)


@pytest.fixture(scope="module")
def library():
    def slopes(function, numbers):
        found = torch.autograd.functional.jacobian(
            lambda *values: function(dict(zip(numbers, values))), tuple(numbers.values())
        )
        return {name: slope.numpy() for name, slope in zip(numbers, found)}

    return SimpleNamespace(
        final=carom.torch.final,
        array=lambda values: torch.tensor(np.asarray(values), dtype=torch.float64),
        jacobians=[slopes],
        compiled=lambda function: function,
    )


def ends(aim, **models):
    return carom.torch.final(TABLE, BALLS, CUE, dict(zip(NAMES, aim.unbind(-1))), **models)


def test_gradients_by_gradcheck_and_of_single_precision():
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


def test_reach_and_flags_are_outputs_without_gradient():
    aim = AIM.clone().requires_grad_()
    assert not any(reach.requires_grad for reach in ends(aim, reach=True).reach.values())
    slope, plain = (
        torch.autograd.grad(ends(aim, reach=has_reach).r[1].sum(), aim)[0]
        for has_reach in (True, False)
    )
    assert torch.equal(slope, plain)
    many = ends(torch.stack([AIM, AIM + 0.01]), reach=True)
    if hasattr(torch, "func"):
        mapped = torch.func.vmap(lambda aim: ends(aim, reach=True).reach["cue.phi"])
        assert torch.equal(mapped(torch.stack([AIM, AIM + 0.01])), many.reach["cue.phi"])
        jacobian = torch.func.jacrev(lambda aim: ends(aim, reach=True).r[1])(AIM)
        assert torch.equal(jacobian, torch.func.jacrev(lambda aim: ends(aim).r[1])(AIM))


def test_second_derivatives_are_those_of_hessian():
    goal = torch.tensor(GOAL, dtype=torch.float64)
    miss = lambda aim: ((ends(aim).r[..., 1, :] - goal) ** 2).sum(-1)  # noqa: E731
    expected, off, first = hessian_of_a_miss()

    def close(found, rtol=1e-09):
        return assert_allclose(found.detach().numpy(), expected, rtol=rtol, atol=rtol)  # noqa: E731

    close(torch.autograd.functional.hessian(miss, AIM))
    aim = AIM.clone().requires_grad_()
    (slope,) = torch.autograd.grad(miss(aim), aim, create_graph=True)
    (second,) = torch.autograd.grad(slope[0], aim, create_graph=True)
    close(torch.stack([second, *second.new_tensor(expected[1:])]))
    with pytest.raises(
        (NotImplementedError, RuntimeError), match="shots have no third derivatives"
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
    assert_allclose(along[0], 2.0 * off @ first, rtol=1e-12)
    assert_allclose(along[1], slopes, rtol=2e-5)
    with pytest.raises(NotImplementedError, match="shots have no third derivatives"):
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
        assert_allclose(slopes(aims), singly, rtol=1e-11)
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
    assert_allclose(aim.grad, singly[0], rtol=1e-11)
