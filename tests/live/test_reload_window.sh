#!/usr/bin/env bash
# Shaders and scenes edited while the window is open: copies of them, never those of the sources.
cd "${NOOK_ROOT:-$PWD}" || exit 1
source tests/support/shell.sh
source tests/support/window.sh

test_saved_shader_is_seen_broken_one_is_in_the_title_and_the_mended_one_is_seen() {
    copy_root
    in_window '
        shader=$root/shaders/render/tone.glsl include=$root/shaders/render/frame.glsl
        press 0; wait_for 30 title_has "0 none"
        sed -i "/^vec3 srgb_encode/,/{/ s/{/{ return vec3(1.0, 0.0, 1.0);/" "$shader"       # writes a new file, renames it
        wait_for 30 has_pixel 160 190 FF00FF
        title_has "0-9 technique"
        printf "float broken = no_such_name;\n" >>"$include"                               # in place, an include
        line=$(wc -l <"$include")
        wait_for 30 title_has "shaders/render/frame.glsl:$line: error: "
        has_pixel 160 190 FF00FF
        sed -i "/no_such_name/d" "$include"
        sed -i "s/vec3(1.0, 0.0, 1.0)/vec3(0.0, 1.0, 0.0)/" "$shader"
        wait_for 30 has_pixel 160 190 00FF00
        wait_for 30 title_has "0-9 technique"'
    grep -q 'shaders/render/frame.glsl:.*no_such_name' "$tmp/log"
    grep -q 'shaders: .* reloaded, .* (shaders/render/tone.glsl' "$tmp/log"
}

# What is drawn while something moves is traced at lower resolution, by shaders that are first built then.
test_occlusion_whose_shaders_never_were_good_is_left_out_until_they_are_mended() {
    copy_root
    in_window '
        shader=$root/shaders/ao/frame.glsl
        wait_for 30 title_has "1 volume .* ms"
        echo "no_such_name;" >>"$shader"
        wait_for 30 title_has "1 volume.*shaders/ao/frame.glsl:"
        hold w
        sed -i "/no_such_name/d" "$shader"
        wait_for 30 title_has "1 volume .* ms.*0-9 technique"
        hold w; wait_for 30 title_has "1 volume .* ms.*0-9 technique"'
}

test_saved_scene_is_seen_and_a_broken_one_is_in_the_title() {
    mkdir -p "$tmp/scene"
    cp "$crate" "$tmp/scene/crate.gltf"
    export crate=$tmp/scene/crate.gltf
    in_window '
        press 0; wait_for 30 title_has "0 none"
        see before
        sed -i "0,/0\\.3,/s//-0.9,/" "$crate"
        wait_for 60 not looks_like before
        sed -i "s/\"asset\"/\"asset/" "$crate"
        wait_for 60 title_has "crate.gltf: "
        sed -i "s/\"asset/\"asset\"/" "$crate"
        wait_for 60 title_has "0-9 technique"'
    [ "$(grep -c 'scene: .*crate.gltf reloaded' "$tmp/log")" -eq 2 ]
}

run_tests
