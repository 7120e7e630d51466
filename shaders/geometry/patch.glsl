// Rays against bilinear patches. Lengths are in units of the size of the patch, directions of length 1: a float may not hold
// the product of three lengths.
#include "shared/bindings.glsl"
#include "base/bilinear.glsl"

BilinearPatch patch_fetch(uint w)
{
    return bilinear_patch_unpack(fetch_instances(w), fetch_instances(w + 1u), fetch_instances(w + 2u),
                                 fetch_instances(w + 3u), fetch_instances(w + 4u), fetch_instances(w + 5u));
}

PatchNormals patch_fetch_normals(uint w)
{
    w += BILINEAR_PATCH_WORDS;
    return patch_normals_unpack(fetch_instances(w), fetch_instances(w + 1u), fetch_instances(w + 2u), fetch_instances(w + 3u));
}

// The patch as seen from a point.
Bilinear patch_from(BilinearPatch record, vec3 origin)
{
    vec3 o = origin / record.size;
    return bilinear_patch(record.p00 - o, record.p10 - o, record.p01 - o, record.p11 - o);
}

// Nearest t_min < t < t_max.
bool patch_hit(BilinearPatch record, vec3 origin, vec3 direction, float t_min, float t_max, out float t)
{
    float rate = length(direction) / record.size;
    BilinearHits hits = bilinear_hits(patch_from(record, origin), normalize(direction));
    float first = hits.first.t / rate;
    float second = hits.second.t / rate;
    bool is_first = first > t_min && !(second > t_min && second < first);
    t = is_first ? first : second;
    return t > t_min && t < t_max;
}
