// Fixed-point numbers of 64 and 96 bits in 32-bit limbs, least significant first. Adding them is associative, so a sum
// does not depend on the order of its terms.

// The largest magnitude that a term may have: 2^20 terms fit 64 bits, and 2^20 squares fit 96.
const float FIXED_LIMIT = 274877906944.0; // 2^38

// The nearest integer to x >= 0, halves upward; x + 0.5 itself may be rounded up to the next.
float fixed_round(float x)
{
    float whole = floor(x);
    return x - whole >= 0.5 ? whole + 1.0 : whole;
}

// The nearest integer to x, |x| <= FIXED_LIMIT, halves away from 0, in two's complement.
uvec2 fixed_from_float(float x)
{
    float a = fixed_round(abs(x));
    float high = floor(a * (1.0 / 4294967296.0));
    uvec2 v = uvec2(uint(a - high * 4294967296.0), uint(high));
    if (x < 0.0) v = uvec2(~v.x + 1u, ~v.y + (v.x == 0u ? 1u : 0u));
    return v;
}

uvec2 fixed_add(uvec2 a, uvec2 b)
{
    uint low = a.x + b.x;
    return uvec2(low, a.y + b.y + (low < a.x ? 1u : 0u));
}

// The integer part of x, 0 <= x <= 2^76, in 96 bits.
uvec3 fixed_wide_from_float(float x)
{
    float a = floor(x);
    float high = floor(a * (1.0 / 4294967296.0) * (1.0 / 4294967296.0));
    a -= high * 4294967296.0 * 4294967296.0;
    float middle = floor(a * (1.0 / 4294967296.0));
    return uvec3(uint(a - middle * 4294967296.0), uint(middle), uint(high));
}

uvec3 fixed_wide_add(uvec3 a, uvec3 b)
{
    uint low = a.x + b.x;
    uint carry = low < a.x ? 1u : 0u;
    uint middle = a.y + b.y;
    uint carry_middle = middle < a.y ? 1u : 0u;
    uint sum = middle + carry;
    carry_middle += sum < middle ? 1u : 0u;
    return uvec3(low, sum, a.z + b.z + carry_middle);
}
