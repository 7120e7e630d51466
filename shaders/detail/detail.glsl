// What a material does to the surface itself.
#include "shared/bindings.glsl"

Detail detail_fetch(uint i)
{
    uint w = i * DETAIL_WORDS;
    return detail_unpack(fetch_details(w), fetch_details(w + 1u), fetch_details(w + 2u), fetch_details(w + 3u), fetch_details(w + 4u));
}
