// Loops of every form. How many rounds they have, and what they compute, is known on paper (loops.toml): n is max_iterations, 5.
int countDown(int from)
{
    int rounds = 0;
    while (from > 0) { // `from` rounds
        --from;
        ++rounds;
    }
    return rounds;
}

int findAtLeast(int least)
{
    for (int i = 1;; i *= 2) { // leaves by its return: least 5 in 4 rounds
        if (i >= least) return i;
    }
}

OwnHit traceOwn(OwnRay ray)
{
    int n = ray.maxIterations;
    int sum = 0;
    for (int i = 0; i < n; ++i) sum += i; // 5 rounds, 10
    for (int i = 0; i < n; ++i) {         // 5 rounds
        for (int j = 0; j < 3; ++j) {     // 15 rounds, 10
            if (j == 1) continue;
            sum += j;
        }
    }
    int k = 0;
    do { // 5 rounds, 4
        ++k;
        if (k == 2) continue;
        ++sum;
    } while (k < n);
    for (;;) { // 3 rounds, 2
        if (k > n + 1) break;
        ++k;
        ++sum;
    }
    for (int i = 0; i < n; ++i) { // 5 rounds, 1 + 100
        switch (i) {
        case 0: sum += 1; break;
        case 3: sum += 100; break;
        default: continue;
        }
    }
    while (n > 5) ++sum;             // no round
    sum += countDown(n) + countDown(2); // 7 rounds, 7
    sum += findAtLeast(n);           // 4 rounds, 8
    return ownHit(vec2(ray.pixel), float(sum));
}
