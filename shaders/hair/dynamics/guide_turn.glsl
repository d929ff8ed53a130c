// Turns of guides as transfer.glsl asks for them, out of the push constants `turns`, `previous_turns` (four
// signed 16 bit each, guide by guide) and `links`.
bool before = false;

vec4 guide_turn(uint guide, uint link) {
    uint i = guide * links + link;
    uvec2 packed = before ? previous_turns.at[i] : turns.at[i];
    return vec4(unpackSnorm2x16(packed.x), unpackSnorm2x16(packed.y));
}
