"""The fused step: the same numbers as ``lad.plain``, in place on one triangle.

Everything that calls each other is in this one file, because numba's cache notices a change only
in the file of the function it compiled.

Layout. ``C`` and ``Q`` are square arrays of which the lower triangle counts. ``basis`` is
(tau, d, room), so that the kernel's inner loop runs over basis vectors. ``alpha`` is (p, room).
"""

import math

import numpy as np

from lad.compiled import compiled


@compiled
def kernel_vector(basis, window, n, squared_temporal_scale, signal_variance, k, scratch):  # type: ignore[no-untyped-def]
    """Equation (7) against the first n basis vectors, into ``k``."""
    depth, d = window.shape
    k[:n] = 1.0
    for lag in range(depth - 1, -1, -1):
        scratch[:n] = 0.0
        for j in range(d):
            value = window[lag, j]
            row = basis[lag, j]
            for i in range(n):
                difference = row[i] - value
                scratch[i] += difference * difference
        for i in range(n):
            k[i] = math.exp(-0.5 * scratch[i] + (k[i] - 1.0) / squared_temporal_scale)
    for i in range(n):
        k[i] *= signal_variance


@compiled
def symmetric_product(matrix, vector, n, out):  # type: ignore[no-untyped-def]
    """Product of the symmetric matrix of a lower triangle and a vector, into ``out``."""
    out[:n] = 0.0
    for a in range(n):
        row = matrix[a]
        value = vector[a]
        total = 0.0
        for b in range(a):
            total += row[b] * vector[b]
            out[b] += row[b] * value
        out[a] += total + row[a] * value


@compiled
def inner(a, b, n):  # type: ignore[no-untyped-def]
    """Inner product of the first n entries."""
    total = 0.0
    for i in range(n):
        total += a[i] * b[i]
    return total


@compiled
def predict(basis, window, n, squared_temporal_scale, signal_variance, C, alpha, work, mean):  # type: ignore[no-untyped-def]
    """Fill k and C k (rows 0 and 1 of ``work``) and ``mean``; return k* + k'Ck."""
    k, Ck, scratch = work[0], work[1], work[2]
    kernel_vector(basis, window, n, squared_temporal_scale, signal_variance, k, scratch)
    symmetric_product(C, k, n, Ck)
    for output in range(alpha.shape[0]):
        mean[output] = inner(alpha[output], k, n)
    return signal_variance + inner(k, Ck, n)


@compiled
def add_outer(matrix, n, factor, vector):  # type: ignore[no-untyped-def]
    """Add factor vector vector' to a lower triangle."""
    for a in range(n):
        row = matrix[a]
        value = factor * vector[a]
        for b in range(a + 1):
            row[b] += value * vector[b]


@compiled
def place(basis, window, slot):  # type: ignore[no-untyped-def]
    """Store the window as a basis vector."""
    depth, d = window.shape
    for lag in range(depth):
        for j in range(d):
            basis[lag, j, slot] = window[lag, j]


@compiled
def residual(Q, n, signal_variance, work):  # type: ignore[no-untyped-def]
    """Fill e = Q k (row 2 of ``work``) and return gamma = k* - k'e."""
    symmetric_product(Q, work[0], n, work[2])
    return signal_variance - inner(work[0], work[2], n)


@compiled
def sparse_update(n, C, alpha, work, gamma, q, r):  # type: ignore[no-untyped-def]
    """Project the sample onto the basis vectors there are."""
    eta = 1.0 / (1.0 + gamma * r)
    s = work[1]
    for i in range(n):
        s[i] += work[2, i]
    for output in range(alpha.shape[0]):
        for i in range(n):
            alpha[output, i] += eta * q[output] * s[i]
    add_outer(C, n, r * eta, s)


@compiled
def full_update(n, C, Q, alpha, work, gamma, q, r):  # type: ignore[no-untyped-def]
    """Add the sample as basis vector n."""
    s, e = work[1], work[2]
    s[n], e[n] = 1.0, -1.0
    C[n, : n + 1] = 0.0
    Q[n, : n + 1] = 0.0
    add_outer(C, n + 1, r, s)
    add_outer(Q, n + 1, 1.0 / gamma, e)
    for output in range(alpha.shape[0]):
        alpha[output, n] = 0.0
        for i in range(n + 1):
            alpha[output, i] += q[output] * s[i]


@compiled
def lowest_score(n, C, Q, alpha, s, e, gamma, q, r):  # type: ignore[no-untyped-def]
    """Find the basis vector to delete as if the full update had been made; n is the new one."""
    best, best_score = 0, np.inf
    for i in range(n + 1):
        diagonal = r * s[i] * s[i] + e[i] * e[i] / gamma
        if i < n:
            diagonal += C[i, i] + Q[i, i]
        score = 0.0
        for output in range(alpha.shape[0]):
            value = q[output] * s[i]
            if i < n:
                value += alpha[output, i]
            score += value * value
        score /= diagonal
        if score < best_score:
            best, best_score = i, score
    return best


@compiled
def column(matrix, n, i, out):  # type: ignore[no-untyped-def]
    """Column i of the symmetric matrix of a lower triangle, into ``out``."""
    for b in range(i + 1):
        out[b] = matrix[i, b]
    for a in range(i + 1, n):
        out[a] = matrix[a, i]


@compiled
def clear(matrix, n, i):  # type: ignore[no-untyped-def]
    """Set row and column i to zero."""
    matrix[i, : i + 1] = 0.0
    for a in range(i + 1, n):
        matrix[a, i] = 0.0


@compiled
def full_update_then_deletion(n, C, Q, alpha, work, gamma, q, r):  # type: ignore[no-untyped-def]
    """Add the sample and delete the lowest score in one pass; return the slot deleted.

    The new sample takes the deleted one's slot; slot n means that it was itself deleted. With
    u = [e; -1], the step is C += r s s' + Q* Q*' / q* - D D' / (q* + c*), D = Q* + C*, and
    Q += u u' / gamma - Q* Q*' / q*.
    """
    s, e, Q_star, D = work[1], work[2], work[3], work[4]
    s[n], e[n] = 1.0, -1.0
    slot = lowest_score(n, C, Q, alpha, s, e, gamma, q, r)
    if slot < n:
        column(Q, n, slot, Q_star)
        column(C, n, slot, D)
        Q_star[n] = D[n] = 0.0
    else:
        Q_star[: n + 1] = 0.0
        D[: n + 1] = 0.0
    for i in range(n + 1):
        Q_star[i] += e[i] * e[slot] / gamma
        D[i] += r * s[i] * s[slot] + Q_star[i]
    q_star, sum_star = Q_star[slot], D[slot]
    for output in range(alpha.shape[0]):
        weight = q[output] * s[slot]
        if slot < n:
            weight += alpha[output, slot]
            alpha[output, slot] = 0.0
        weight /= sum_star
        value = q[output]
        if slot < n:
            s_slot, D_slot = s[slot], D[slot]
            s[slot], D[slot] = s[n], D[n]
        for i in range(n):
            alpha[output, i] += value * s[i] - weight * D[i]
        if slot < n:
            s[slot], D[slot] = s_slot, D_slot
    if slot < n:
        clear(C, n, slot)
        clear(Q, n, slot)
        s[slot], e[slot], Q_star[slot], D[slot] = s[n], e[n], Q_star[n], D[n]
    for a in range(n):
        C_row, Q_row = C[a], Q[a]
        sa, qa, da = r * s[a], Q_star[a] / q_star, D[a] / sum_star
        ea = e[a] / gamma
        for b in range(a + 1):
            C_row[b] += sa * s[b] + qa * Q_star[b] - da * D[b]
            Q_row[b] += ea * e[b] - qa * Q_star[b]
    return slot
