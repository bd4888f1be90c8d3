/**
 * bone_scene.h - an arm of two bones as a scene, made by code: what bends it and what comes out is known on paper.
 *
 * Nodes: 0 root, 1 the arm's mesh, 2 upper bone at the root's origin, 3 lower bone 1 m above it; both below the root. The mesh is a
 * strip of triangles in the plane z = 0, x = +-0.1, from y = 0 to 2, facing +z; vertices at y < 1 follow the upper bone, at y > 1
 * the lower one, at y = 1 both by half. One morph target lifts the tip (y = 2) by 1 m along x. Its one clip, "bend", turns the lower
 * bone about +z from 0 to a quarter turn within 2 seconds, and the target's weight from 0 to 1.
 */
#pragma once
#include "engine/asset/scene.h"

enum { BONE_SCENE_ROWS = 9, BONE_SCENE_LOWER = 3, BONE_SCENE_MESH_NODE = 1 };

/** Loaded from a file in the scratch folder, like any other. @param root  where the root stands, metres @return destroy it */
nook_scene *bone_scene_load(const double root[3]);
/** The same with holes: of every half metre along it the first half is there, by a mask. */
nook_scene *bone_scene_load_masked(const double root[3]);
