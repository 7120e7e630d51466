// The colours of numbers from 0 to 1: black, violet, red, orange, light yellow. What looks like an even step is one: the lightness of
// OKLab (Björn Ottosson 2020, A perceptual color space for image processing) is 0.98 x, and its two other coordinates follow
// polynomials that hardly leave the colours of sRGB: what is cut off there moves the lightness by at most 0.003.

const float HEAT_LIGHTNESS = 0.98;

vec3 linear_of_oklab(vec3 lab)
{
    float l = lab.x + 0.3963377774 * lab.y + 0.2158037573 * lab.z;
    float m = lab.x - 0.1055613458 * lab.y - 0.0638541728 * lab.z;
    float s = lab.x - 0.0894841775 * lab.y - 1.2914855480 * lab.z;
    vec3 cubes = vec3(l * l * l, m * m * m, s * s * s);
    return vec3(dot(vec3(4.0767416621, -3.3077115913, 0.2309699292), cubes),
                dot(vec3(-1.2684380046, 2.6097574011, -0.3413193965), cubes),
                dot(vec3(-0.0041960863, -0.7034186147, 1.7076147010), cubes));
}

// Linear red, green and blue; what is below 0 or beyond 1 is as 0 or 1.
vec3 heat(float x)
{
    x = clamp(x, 0.0, 1.0);
    float red_green = x * x * (1.35 + x * (-0.24 + x * (-3.53 + x * 2.38)));
    float yellow_blue = x * (-0.69 + x * (0.44 + x * (4.99 + x * (-7.75 + x * 3.12))));
    return clamp(linear_of_oklab(vec3(HEAT_LIGHTNESS * x, red_green, yellow_blue)), 0.0, 1.0);
}
