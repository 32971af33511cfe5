# ruff: noqa: PLR0917  # compiled code takes arrays apart from objects
"""The fused step: the numbers of ``lad.plain``, in place on one triangle.

Everything that calls each other is in this one file, because numba's cache notices a change only
in the file of the function it compiled.

Layout. ``C`` and ``Q`` are lower triangles whose rows begin at ``starts`` (``lad.triangle``, whose
``row_of`` is the one function from elsewhere). ``basis`` is (tau, d, room), so that the kernel's
inner loop runs over basis vectors; ``alpha`` is (p, room). The rows of ``work`` are the vectors of
the step in progress: k, then s (at first C k), then e = Q k, then the starred columns of a
deletion. ``predict`` uses the row of e as scratch, because ``learn`` fills it only later.
"""

from typing import Any

import numpy as np
from numba import types
from numba.extending import intrinsic
from numpy.typing import NDArray

from lad.compiled import compiled, compiled_sums
from lad.triangle import Starts, Vector, row_of
from lad.update import SMALLEST_SHARE

Matrix = NDArray[np.float64]
K_ROW, S_ROW, E_ROW, Q_STAR_ROW, D_ROW = range(5)
SPARSE, FULL, REPLACED = 1, 2, 3

LOG2_E = 1.4426950408889634
LN2_HIGH = 6.93147180369123816490e-01
LN2_LOW = 1.90821492927058770002e-10
"""ln 2 in two parts: the first one ends in zeros, so n times it is exact for every n used here."""
ROUNDER = 6755399441055744.0
"""1.5 * 2^52: adding it rounds to a whole number and leaves it in the lowest bits of the sum."""
LOWEST_EXPONENT = -80.0
"""Keeps the result a normal number; a covariance of e^-80 = 2e-35 changes no sum."""


def _reinterpretation(source: Any, target: Any) -> Any:
    """Build a move of bits between registers; unlike a view of memory it lets a loop vectorise."""

    def typed(_context: Any, _value: Any) -> Any:
        def generate(context: Any, builder: Any, _signature: Any, args: Any) -> Any:
            return builder.bitcast(args[0], context.get_value_type(target))

        return target(source), generate

    return intrinsic(typed)


bits_of = _reinterpretation(types.float64, types.int64)
from_bits = _reinterpretation(types.int64, types.float64)


@compiled
def exp_of_nonpositive(x: float) -> float:
    """e^x for x <= 0, within one unit in the last place; below -80 it stays at e^-80 = 2e-35.

    Written out because the library's exp is a call, and a loop with a call in it is not
    vectorised: x = n ln 2 + r with |r| <= ln 2 / 2, a Taylor polynomial of degree 13 in r, and n
    added to the exponent bits.
    """
    x = max(x, LOWEST_EXPONENT)
    shifted = x * LOG2_E + ROUNDER
    n = shifted - ROUNDER
    r = (x - n * LN2_HIGH) - n * LN2_LOW
    p = 1.0 / 6227020800.0
    p = p * r + 1.0 / 479001600.0
    p = p * r + 1.0 / 39916800.0
    p = p * r + 1.0 / 3628800.0
    p = p * r + 1.0 / 362880.0
    p = p * r + 1.0 / 40320.0
    p = p * r + 1.0 / 5040.0
    p = p * r + 1.0 / 720.0
    p = p * r + 1.0 / 120.0
    p = p * r + 1.0 / 24.0
    p = p * r + 1.0 / 6.0
    p = p * r + 0.5
    p = p * r + 1.0
    p = p * r + 1.0
    return from_bits(bits_of(p) + (bits_of(shifted) << 52))  # type: ignore[no-any-return]


@compiled
def kernel_vector(
    basis: Vector,
    window: Matrix,
    n: int,
    inverse_scale: float,
    signal_variance: float,
    constant_variance: float,
    k: Vector,
    distance: Vector,
) -> None:
    """Equation (7) against the first n basis vectors, into ``k``; ``distance`` is scratch.

    ``inverse_scale`` is 1 / sigma_rho^2; a constant variance of 0 changes no bit. Inputs are taken
    four at a time: one load and store of the running sum for four of them.
    """
    depth, d = window.shape
    # The recursion starts at the oldest input and ends at the newest; k - 1 is 0 before the first.
    k[:n] = 1.0
    for lag in range(depth - 1, -1, -1):
        distance[:n] = 0.0
        for j in range(0, d - 3, 4):
            x0, x1, x2, x3 = window[lag, j : j + 4]
            b0, b1 = basis[lag, j], basis[lag, j + 1]
            b2, b3 = basis[lag, j + 2], basis[lag, j + 3]
            for i in range(n):
                d0, d1, d2, d3 = b0[i] - x0, b1[i] - x1, b2[i] - x2, b3[i] - x3
                distance[i] += (d0 * d0 + d1 * d1) + (d2 * d2 + d3 * d3)
        for j in range(d - d % 4, d):
            x0, b0 = window[lag, j], basis[lag, j]
            for i in range(n):
                d0 = b0[i] - x0
                distance[i] += d0 * d0
        for i in range(n):
            k[i] = exp_of_nonpositive(-0.5 * distance[i] + (k[i] - 1.0) * inverse_scale)
    for i in range(n):
        k[i] = signal_variance * k[i] + constant_variance


@compiled_sums
def symmetric_product(triangle: Vector, starts: Starts, x: Vector, n: int, out: Vector) -> None:
    """Product of the symmetric matrix of a lower triangle and x, into ``out``.

    One pass over the triangle, four rows at a time: each row counts once as a row and once as
    a column.
    """
    # At 800 vectors the triangle is larger than the fast caches, so memory sets the time. Four
    # rows at a time load and store ``out`` a quarter as often; four totals do not wait in turn.
    out[:n] = 0.0
    last = n - n % 4
    for a in range(0, last, 4):
        r0, r1 = row_of(triangle, starts, a), row_of(triangle, starts, a + 1)
        r2, r3 = row_of(triangle, starts, a + 2), row_of(triangle, starts, a + 3)
        x0, x1, x2, x3 = x[a], x[a + 1], x[a + 2], x[a + 3]
        t0 = t1 = t2 = t3 = 0.0
        for b in range(a):
            m0, m1, m2, m3 = r0[b], r1[b], r2[b], r3[b]
            t0 += m0 * x[b]
            t1 += m1 * x[b]
            t2 += m2 * x[b]
            t3 += m3 * x[b]
            out[b] += (m0 * x0 + m1 * x1) + (m2 * x2 + m3 * x3)
        out[a] = t0 + r0[a] * x0 + r1[a] * x1 + r2[a] * x2 + r3[a] * x3
        out[a + 1] = t1 + r1[a] * x0 + r1[a + 1] * x1 + r2[a + 1] * x2 + r3[a + 1] * x3
        out[a + 2] = t2 + r2[a] * x0 + r2[a + 1] * x1 + r2[a + 2] * x2 + r3[a + 2] * x3
        out[a + 3] = t3 + r3[a] * x0 + r3[a + 1] * x1 + r3[a + 2] * x2 + r3[a + 3] * x3
    for a in range(last, n):
        row, xa, total = row_of(triangle, starts, a), x[a], 0.0
        for b in range(a):
            total += row[b] * x[b]
            out[b] += row[b] * xa
        out[a] = total + row[a] * xa


@compiled_sums
def inner(a: Vector, b: Vector, n: int) -> float:
    """Inner product of the first n entries."""
    total = 0.0
    for i in range(n):
        total += a[i] * b[i]
    return total


@compiled
def predict(
    n: int,
    C: Vector,
    starts: Starts,
    alpha: Matrix,
    basis: Vector,
    work: Matrix,
    window: Matrix,
    inverse_scale: float,
    signal_variance: float,
    constant_variance: float,
    mean: Vector,
) -> float:
    """Fill k and C k, and ``mean`` by equation (8); return equation (9), NaN with a NaN mean."""
    k, Ck = work[K_ROW], work[S_ROW]
    kernel_vector(
        basis, window, n, inverse_scale, signal_variance, constant_variance, k, work[E_ROW]
    )
    symmetric_product(C, starts, k, n, Ck)
    latent = signal_variance + constant_variance + inner(k, Ck, n)
    for output in range(alpha.shape[0]):
        mean[output] = inner(alpha[output], k, n)
        if not np.isfinite(mean[output]):
            latent = np.nan
    return latent


@compiled
def add_outer(triangle: Vector, starts: Starts, n: int, factor: float, x: Vector) -> None:
    """Add factor x x' to a lower triangle."""
    for a in range(n):
        row, value = row_of(triangle, starts, a), factor * x[a]
        for b in range(a + 1):
            row[b] += value * x[b]


@compiled
def add_to_alpha(alpha: Matrix, n: int, q: Vector, factor: float, s: Vector) -> None:
    """Alpha += factor s q'."""
    for output in range(alpha.shape[0]):
        row, value = alpha[output], factor * q[output]
        for i in range(n):
            row[i] += value * s[i]


@compiled
def sparse_update(
    n: int,
    C: Vector,
    starts: Starts,
    alpha: Matrix,
    work: Matrix,
    gamma: float,
    q: Vector,
    r: float,
) -> None:
    """Project the sample onto the basis vectors there are."""
    eta = 1.0 / (1.0 + gamma * r)
    s, e = work[S_ROW], work[E_ROW]
    for i in range(n):
        s[i] += e[i]
    add_to_alpha(alpha, n, q, eta, s)
    add_outer(C, starts, n, r * eta, s)


@compiled
def full_update(
    n: int,
    C: Vector,
    Q: Vector,
    starts: Starts,
    alpha: Matrix,
    work: Matrix,
    gamma: float,
    q: Vector,
    r: float,
) -> None:
    """Add the sample as basis vector n."""
    s, e = work[S_ROW], work[E_ROW]
    s[n], e[n] = 1.0, -1.0
    row_of(C, starts, n)[:] = 0.0
    row_of(Q, starts, n)[:] = 0.0
    alpha[:, n] = 0.0
    add_to_alpha(alpha, n + 1, q, 1.0, s)
    add_outer(C, starts, n + 1, r, s)
    add_outer(Q, starts, n + 1, 1.0 / gamma, e)


@compiled
def lowest_score(
    n: int,
    C: Vector,
    Q: Vector,
    starts: Starts,
    alpha: Matrix,
    work: Matrix,
    gamma: float,
    q: Vector,
    r: float,
) -> int:
    """Find the slot to delete after a full update that has not been made yet; n is the new one."""
    s, e, scores = work[S_ROW], work[E_ROW], work[D_ROW]
    scores[: n + 1] = 0.0
    for output in range(alpha.shape[0]):
        row = alpha[output]
        for i in range(n):
            value = row[i] + q[output] * s[i]
            scores[i] += value * value
        scores[n] += q[output] * q[output]
    # Rounding can bring q* + c* to 0 or below for a well-observed vector. Without the least share
    # its score would be negative, and an important vector would be deleted.
    for i in range(n):
        q_star = Q[starts[i] + i] + e[i] * e[i] / gamma
        c_star = C[starts[i] + i] + r * s[i] * s[i]
        scores[i] /= max(q_star + c_star, SMALLEST_SHARE * q_star)
    scores[n] /= max(1.0 / gamma + r, SMALLEST_SHARE / gamma)
    return int(np.argmin(scores[: n + 1]))


@compiled
def starred_columns(
    n: int, slot: int, C: Vector, Q: Vector, starts: Starts, work: Matrix, gamma: float, r: float
) -> None:
    """Fill Q* and D = Q* + C*, the columns of the updated matrices that belong to ``slot``."""
    s, e, Q_star, D = work[S_ROW], work[E_ROW], work[Q_STAR_ROW], work[D_ROW]
    Q_star[: n + 1] = 0.0
    D[: n + 1] = 0.0
    if slot < n:
        Q_star[: slot + 1] = row_of(Q, starts, slot)
        D[: slot + 1] = row_of(C, starts, slot)
        for a in range(slot + 1, n):
            Q_star[a], D[a] = Q[starts[a] + slot], C[starts[a] + slot]
    for i in range(n + 1):
        Q_star[i] += e[i] * (e[slot] / gamma)
        D[i] += r * s[i] * s[slot] + Q_star[i]


@compiled
def move_new_into(
    slot: int, n: int, C: Vector, Q: Vector, starts: Starts, alpha: Matrix, work: Matrix
) -> None:
    """Give the deleted vector's slot to the new one, whose entries were zero so far."""
    row_of(C, starts, slot)[:] = 0.0
    row_of(Q, starts, slot)[:] = 0.0
    for a in range(slot + 1, n):
        C[starts[a] + slot] = 0.0
        Q[starts[a] + slot] = 0.0
    alpha[:, slot] = 0.0
    for row in range(S_ROW, D_ROW + 1):
        work[row, slot] = work[row, n]


@compiled
def update_and_delete(
    n: int,
    C: Vector,
    Q: Vector,
    starts: Starts,
    alpha: Matrix,
    work: Matrix,
    gamma: float,
    q: Vector,
    r: float,
) -> int:
    """Add the sample, delete the lowest score, in one pass; return the slot of the deleted.

    The new vector takes that slot; slot n means that it was itself deleted. With u = [e; -1] and
    D = Q* + C* the whole step is C += r s s' + Q* Q*' / q* - D D' / (q* + c*) and
    Q += u u' / gamma - Q* Q*' / q*, which is nothing for slot n.
    """
    s, e, Q_star, D = work[S_ROW], work[E_ROW], work[Q_STAR_ROW], work[D_ROW]
    s[n], e[n] = 1.0, -1.0
    slot = lowest_score(n, C, Q, starts, alpha, work, gamma, q, r)
    starred_columns(n, slot, C, Q, starts, work, gamma, r)
    by_q = 1.0 / Q_star[slot]
    by_d = 1.0 / max(D[slot], SMALLEST_SHARE * Q_star[slot])
    # The deleted entries of alpha, read before ``move_new_into`` overwrites their slot.
    weights = np.empty(alpha.shape[0])
    for output in range(alpha.shape[0]):
        weights[output] = q[output] * s[slot]
        if slot < n:
            weights[output] += alpha[output, slot]
    if slot < n:
        move_new_into(slot, n, C, Q, starts, alpha, work)
    add_to_alpha(alpha, n, q, 1.0, s)
    add_to_alpha(alpha, n, weights, -by_d, D)
    # One pass for three outer products: reading and writing C costs more than the arithmetic.
    for a in range(n):
        row = row_of(C, starts, a)
        sa, qa, da = r * s[a], by_q * Q_star[a], by_d * D[a]
        for b in range(a + 1):
            row[b] += sa * s[b] + qa * Q_star[b] - da * D[b]
    if slot == n:  # the new one was deleted, so Q stays: u u' / gamma = Q* Q*' / q*
        return slot
    for a in range(n):
        row, ea, qa = row_of(Q, starts, a), e[a] / gamma, by_q * Q_star[a]
        for b in range(a + 1):
            row[b] += ea * e[b] - qa * Q_star[b]
    return slot


@compiled
def learn(
    n: int,
    capacity: int,
    C: Vector,
    Q: Vector,
    starts: Starts,
    alpha: Matrix,
    work: Matrix,
    prior: float,
    least_novel: float,
    q: Vector,
    r: float,
) -> tuple[int, float, int]:
    """Take in the sample whose k and C k ``predict`` has filled.

    Returns
    -------
    tuple
        What was done (SPARSE, FULL or REPLACED), gamma, and the slot of the new vector; n with
        REPLACED means that the new vector was itself deleted.
    """
    symmetric_product(Q, starts, work[K_ROW], n, work[E_ROW])
    gamma = prior - inner(work[K_ROW], work[E_ROW], n)
    if gamma < least_novel:
        sparse_update(n, C, starts, alpha, work, gamma, q, r)
        return SPARSE, gamma, n
    if n < capacity:
        full_update(n, C, Q, starts, alpha, work, gamma, q, r)
        return FULL, gamma, n
    return REPLACED, gamma, update_and_delete(n, C, Q, starts, alpha, work, gamma, q, r)


@compiled
def likeliest_wrong(n: int, new: int, Q: Vector, starts: Starts, work: Matrix) -> int:
    """Find the basis vector whose column of QK - I has probably gained the largest error.

    The column of the new vector itself is nearly exact.
    """
    k, best, largest = work[K_ROW], 0, -1.0
    for i in range(n):
        weight = Q[starts[i] + i] * k[i]
        if weight > largest and i != new:
            best, largest = i, weight
    return best
