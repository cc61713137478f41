// A pixel as listPixel() of common/pixel_list.glsl writes it.
#ifndef AG_LISTED_PIXEL_GLSL
#define AG_LISTED_PIXEL_GLSL
ivec2 listedPixel(uint packed) { return ivec2(packed & 0xffffu, packed >> 16); }
#endif
