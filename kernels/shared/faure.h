// Owen-scrambled points of four dimensions, Faure's, one set of them for each decision of a path.
//
// The points are a digital (0,4)-sequence in base 4 whose pairs (x, y) and (z, w) are (0,2)-
// sequences in base 2: Faure's construction over the field of four elements {0, 1, g, g^2}, written
// in bits (Niederreiter 1987; Ahmed, Wonka et al. 2024, "SZ Sequences: Binary-Based (0, 2^q)-
// Sequences"). It stratifies like the first dimensions of Sobol's sequence or better and needs no
// tables. Sets are padded (Kollig and Keller 2002): each takes the points in an order of its own
// and with scrambles of its own, so that they are independent of each other (Burley 2020,
// "Practical Hash-based Owen Scrambling", JCGT 9(4)).
//
// Numbers are held with their most significant digit in the lowest bits until the last step: there
// a carry runs the way in which a digit may depend on those before it. The generator matrices are
// upper triangular with a unit diagonal, so every dimension takes each value of 2^m samples once.

FN Uint reverse_bits(Uint x) {
    x = (x << 16) | (x >> 16);
    x = ((x & 0x00ff00ffu) << 8) | ((x >> 8) & 0x00ff00ffu);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
    x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
    return ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
}

/// A permutation in which a bit depends on itself and on those below it, and flips evenly over the
/// seeds (Laine and Karras 2011; constants of Vegdahl 2021, "Building a Better LK Hash", whose last
/// multiplication changes nothing that the tests can see).
FN Uint laine_karras(Uint x, Uint seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    return x ^ (x * 0x05526c56u);
}

/// Nested uniform (Owen) scramble of a number given in reverse, put the right way round.
FN Uint owen_scramble(Uint reversed, Uint seed) {
    return reverse_bits(laine_karras(reversed, seed));
}

/// Pascal's matrix modulo 2 times x, which it takes as 16 digits of two bits: digit r becomes the
/// sum of binomial(c, r) times digit c. It is a Kronecker power of (1 1; 0 1).
FN Uint pascal_digits(Uint x) {
    x ^= x >> 16;
    x ^= (x >> 8) & 0x00ff00ffu;
    x ^= (x >> 4) & 0x0f0f0f0fu;
    return x ^ ((x >> 2) & 0x33333333u);
}

/// Digit c times g^c and times g^2c, a digit (h, l) being h g + l: g (h, l) = (h + l, h). The masks
/// have a period of three digits, since g^3 = 1.
typedef struct {
    Uint once, twice;
} GeneratorPowers;
FN GeneratorPowers times_generator_powers(Uint x) {
    Uint swapped = ((x << 1) & 0x28a28a28u) ^ ((x >> 1) & 0x14514514u);
    GeneratorPowers p;
    p.once = swapped ^ (x & 0xdb6db6dbu);
    p.twice = swapped ^ (x & 0xe79e79e7u);
    return p;
}

/// Digit (h, l) becomes (h, l + h): makes pairs of dimensions (0,2)-sequences in base 2.
FN Uint shear_digits(Uint x) { return x ^ ((x >> 1) & 0x55555555u); }

/// Point number `index` of the sequence, each coordinate in reverse.
FN Random4 faure_point(Uint index) {
    GeneratorPowers powers = times_generator_powers(index);
    Random4 p;
    p.x = index;
    p.y = shear_digits(pascal_digits(index));
    p.z = shear_digits(times_generator_powers(pascal_digits(powers.once)).twice);
    p.w = times_generator_powers(pascal_digits(powers.twice)).once;
    return p;
}

/// Which of a pixel's samples it is. The pattern may be several patterns that take turns,
/// replicates, each with scrambles of its own: their means differ by the error that each has.
typedef struct {
    Uint pixel, seed, index, replicate;
} SampleNumber;

/// Of 2^replicate_bits replicates.
FN SampleNumber sample_number(Uint pixel, Uint sample, Uint seed, int replicate_bits) {
    SampleNumber n;
    n.pixel = pixel;
    n.seed = seed;
    n.index = sample;
    n.replicate = (Uint)0u;
    if (HAS(replicates)) {
        n.index = sample >> replicate_bits;
        n.replicate = sample ^ (n.index << replicate_bits);
    }
    return n;
}

/// Four 32-bit numbers for one decision: the sample's point of the set that belongs to the pixel,
/// the decision and the replicate.
FN Random4 faure4(SampleNumber n, Uint set) {
    Random4 scramble = random4(n.pixel, (Uint)0x5eedu + n.replicate, set, n.seed);
    Uint order = (scramble.x ^ (scramble.y >> 15)) * 0x2c1b3c6du;
    order ^= order >> 16;
    Random4 p = faure_point(owen_scramble(reverse_bits(n.index), order));
    p.x = owen_scramble(p.x, scramble.x);
    p.y = owen_scramble(p.y, scramble.y);
    p.z = owen_scramble(p.z, scramble.z);
    p.w = owen_scramble(p.w, scramble.w);
    return p;
}

/// The numbers of one decision in the pattern that the render asks for.
FN Random4 sampler_draw(SampleNumber n, Uint set) {
    if (HAS(faure)) return faure4(n, set);
    return random4(n.pixel, n.index, set, n.seed);
}
