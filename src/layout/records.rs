//! The records that host and kernels share.

use super::{Field, Record, RecordInfo};

records! {
    /// All that stays the same during a slice, in a uniform block (std140).
    struct Frame {
        /// camera space x in world space
        camera_right: [f32; 3],
        /// half of the width of the picture: tangent, scene units of parallel rays, radii of a fisheye circle, or mm of film
        half_x: f32,
        /// camera space y in world space
        camera_up: [f32; 3],
        /// half of the height of the picture, in the same unit
        half_y: f32,
        /// camera space z in world space: the camera looks along its negative
        camera_back: [f32; 3],
        /// radius of the lens, scene units; 0 = pinhole
        lens_radius: f32,
        /// position of the camera
        camera_position: [f32; 3],
        /// distance of the plane of focus, scene units
        focus_distance: f32,
        /// plane of focus n · p = d of a thin lens, as n / d; n and p to the right, up and along the view
        focus_plane: [f32; 3],
        /// distance of the second opening of a thin lens, radii
        cat_eye: f32,
        /// half of the width and height of the opening, radii
        opening_half: [f32; 2],
        /// columns and rows of the picture of the opening
        opening_size: [u32; 2],
        /// first word of `lens` with its cells
        opening_cells: u32,
        /// interfaces of the lens
        lens_count: u32,
        /// the one that is the stop
        lens_stop: u32,
        /// radius of the stop, millimetres
        stop_radius: f32,
        /// from the film to the last vertex, millimetres
        lens_rear: f32,
        /// factor on cos⁴ θ · area, which gives the weight of a ray; one over square millimetres
        lens_weight: f32,
        /// scene units in a millimetre
        lens_unit: f32,
        /// angle of a millimetre of film, radians
        lens_spread: f32,
        /// first word of `lens` with bounds of the exit pupil
        pupil_bounds: u32,
        /// intervals of these in a millimetre of film
        pupil_scale: f32,
        /// half the angle of a fisheye in radians; equisolid: the sine of half of that
        fisheye_scale: f32,
        /// first word of `instances` with the motion of the camera, whose own fields are then those of camera space
        camera_motion: u32,
        /// corners of the aperture; 0 = circle
        blades: u32,
        /// rotation of the aperture, radians
        blade_rotation: f32,
        /// half-width of the pixel filter, pixels
        filter_radius: f32,
        /// seed of all random numbers
        seed: u32,
        /// size of the whole picture, pixels
        film_size: [u32; 2],
        /// first column and row that is rendered
        window_min: [u32; 2],
        /// one past the last column and row that is rendered
        window_max: [u32; 2],
        /// tiles in a row of the window
        tiles_x: u32,
        /// threads that share a dispatch in contiguous parts; 1 on a GPU
        threads: u32,
        /// first tile of the slice, row by row
        first_tile: u32,
        /// tiles of the slice
        tile_count: u32,
        /// first sample of the slice
        first_sample: u32,
        /// samples a pixel in the slice
        sample_count: u32,
        /// strata of a pixel in x and y
        strata: [u32; 2],
        /// most scattering events on a path
        max_depth: u32,
        /// most scattering events that are neither mirror nor clear glass
        diffuse_bounces: u32,
        /// slots of the slice: WORKGROUP · tile_count · sample_count
        slot_count: u32,
        /// entry of the tree that rays start at
        root: u32,
        /// most steps of a ray in one dispatch, before it is parked
        step_limit: u32,
        /// lights in the table, the environment left out
        light_count: u32,
        /// chance of choosing the environment when a light is chosen
        environment_chance: f32,
        /// largest component that indirect light of one sample may have; 0 = no limit
        firefly_clamp: f32,
        /// 1 / unit of the sums of radiance
        radiance_scale: f32,
        /// 1 / unit of the sums of depth
        depth_scale: f32,
        /// row 0 of the rotation from world directions to those of the environment
        environment_row0: [f32; 3],
        /// factor on the radiance of the environment
        environment_scale: f32,
        /// row 1 of that rotation
        environment_row1: [f32; 3],
        /// texture of the environment, or NONE
        environment_texture: u32,
        /// row 2 of that rotation
        environment_row2: [f32; 3],
        /// first tile of the film band that is resident
        film_first_tile: u32,
        /// constant radiance of the environment
        environment_radiance: [f32; 3],
        /// tiles of the film band that is resident
        film_tile_count: u32,
        /// columns and rows of the importance table of the environment
        environment_size: [u32; 2],
        /// entries of the stack of a parked ray
        parked_stack: u32,
        /// points of the evaluate and probe kernels
        point_count: u32,
        /// first word of `lens` with the cells of the pixel filter
        filter_cells: u32,
        /// magnitude of the pixel filter over its whole, by which samples are weighted
        filter_weight: f32,
        /// room
        spare: u32,
        /// material of the glass around the camera, or NONE
        camera_medium: u32,
    }

    /// Up to four children of a BVH node, with their boxes in bytes: corner = origin + byte · 2^(exponent − 127), rounded
    /// outwards (Ylitie, Karras and Laine 2017, section 3, with four children in place of eight). The items of all children,
    /// nodes and primitives, lie one after another.
    struct Node {
        /// least corner of all children
        origin: [f32; 3],
        /// exponents of the steps along x, y and z, a byte each
        exponents: u32,
        /// least corners along x, y and z; a byte for each child
        low: [u32; 3],
        /// first item of the children
        base: u32,
        /// greatest corners along x, y and z; a byte for each child
        high: [u32; 3],
        /// a byte for each child: CHILD_NONE, or its first item counted from `base`, and the upper bits of its reference
        children: u32,
    }

    /// A triangle in the order of the tree. As many words as a [`Node`]: both are an [`Item`](super::Item) of one buffer.
    struct Triangle {
        /// first vertex, in the space of its tree
        a: [f32; 3],
        /// instance, when the tree is in world space; else NONE
        instance: u32,
        /// second vertex
        b: [f32; 3],
        /// its material, or NONE for that of the instance
        material: u32,
        /// third vertex
        c: [f32; 3],
        /// number of the triangle within its mesh, and one of the bits PRIMITIVE_LETS_THROUGH and PRIMITIVE_FRONT_ONLY
        primitive: u32,
    }

    /// Where the shading data of a triangle are, in the order of its mesh.
    struct Face {
        /// three Vertex records
        vertices: [u32; 3],
        /// word of `faces` with what only textures ask of its corners, or NONE: CornerColors, then CornerUvs, those that the scene uses
        extra: u32,
    }

    /// Colours of the corners of a triangle, linear, with alpha.
    struct CornerColors {
        /// of the first
        a: [f32; 4],
        /// of the second
        b: [f32; 4],
        /// of the third
        c: [f32; 4],
    }

    /// Second texture coordinates of the corners of a triangle.
    struct CornerUvs {
        /// of the first
        a: [f32; 2],
        /// of the second
        b: [f32; 2],
        /// of the third
        c: [f32; 2],
        /// room
        spare: [f32; 2],
    }

    /// Shading data of a vertex.
    struct Vertex {
        /// normal of any length, or 0 when the mesh is flat
        normal: [f32; 3],
        /// texture coordinate, rightward
        u: f32,
        /// texture coordinate, upward
        v: f32,
        /// tangent in the space of the normal: 1 long, or 2 when its bitangent is on the other side; 0 = there is none
        tangent: [f32; 3],
    }

    /// A shape or mesh in the world. Rows are of 3×4 matrices.
    struct Instance {
        /// INSTANCE_… kind
        kind: u32,
        /// root of its tree, for meshes; first word of `instances` with what else there is to know of a shape; or NONE
        root: u32,
        /// first light of its surface, or NONE
        light: u32,
        /// material of what has none of its own
        material: u32,
        /// row 0 of object from world
        object_row0: [f32; 4],
        /// row 1 of object from world
        object_row1: [f32; 4],
        /// row 2 of object from world
        object_row2: [f32; 4],
        /// row 0 of world from object
        world_row0: [f32; 4],
        /// row 1 of world from object
        world_row1: [f32; 4],
        /// row 2 of world from object
        world_row2: [f32; 4],
        /// 1, or -1 when the map to the world mirrors
        handedness: f32,
        /// first word of `instances` with its Motion, or NONE
        motion: u32,
        /// Face of its first triangle, or NONE for flat triangles without uv
        first_face: u32,
        /// INSTANCE_… flags
        flags: u32,
    }

    /// What a material is. Its inputs follow.
    struct MaterialHead {
        /// MATERIAL_… kind
        kind: u32,
        /// FRESNEL_… rule of a conductor, or DIELECTRIC_… mode
        mode: u32,
        /// MATERIAL_… flags
        flags: u32,
        /// 1 / Abbe number of glass; 0 = all colours have one index
        dispersion: f32,
    }

    /// A colour of a material. A texture is a reference, whose bits `prepare` and the code that it generates know, or NONE.
    struct ColorInput {
        /// the colour, or a factor on that of the texture
        value: [f32; 3],
        /// its texture
        texture: u32,
    }

    /// Two numbers of a material.
    struct NumberInputs {
        /// the first number, or a factor on that of its texture
        first: f32,
        /// its texture
        first_texture: u32,
        /// the second number, or a factor on that of its texture
        second: f32,
        /// its texture
        second_texture: u32,
    }

    /// What an interface over an opaque base lets through. A table has INTERFACE_ROWS · INTERFACE_COLUMNS words, one a cell with its
    /// values at the corners, and then INTERFACE_ROWS with the means at the ends of a row.
    struct InterfaceInput {
        /// word of `materials` with the table of what it lets through when rough, or NONE
        through_table: u32,
        /// word with the table of what leaves rough metal below it, or NONE
        inner_table: u32,
        /// what it lets through when smooth of light from everywhere: 2 ∫ T(μ) μ dμ
        through_mean: f32,
        /// room
        spare: u32,
    }

    /// What a mix is made of.
    struct MixInput {
        /// chance of the second material, or a factor on that of its texture
        amount: f32,
        /// its texture
        amount_texture: u32,
        /// material for an amount of 0
        first: u32,
        /// material for an amount of 1
        second: u32,
    }

    /// What a material does to the surface itself: its opacity and its relief. Texture fields are references, or NONE.
    struct Detail {
        /// how much of the surface is there, 0 to 1
        opacity: f32,
        /// texture of opacity, a factor on it
        opacity_texture: u32,
        /// opacity from which a point is there, or less than 0: each point is there to a part
        cutoff: f32,
        /// texture of the filter, a factor on it
        filter_texture: u32,
        /// colour of light that goes straight through
        filter_color: [f32; 3],
        /// DETAIL_… flags
        flags: u32,
        /// texture of the height of a bump map, or NONE
        height_texture: u32,
        /// factor on the height, scene units
        height: f32,
        /// DERIVATIVE_… rule of the height
        derivative: u32,
        /// texture of a normal map, or NONE
        normal_texture: u32,
        /// what one step of the derivative along its first axis adds to uv
        step_x: [f32; 2],
        /// the same along its second axis
        step_y: [f32; 2],
        /// steps, whole at texel centres, of the uv (0, 0)
        steps_at_zero: [f32; 2],
        /// factor on the tilt of a normal map
        strength: f32,
        /// room
        spare: u32,
    }

    /// A light, with its place in the alias table (Vose 1991) that chooses by power.
    struct Light {
        /// LIGHT_… kind
        kind: u32,
        /// chance of choosing it
        chance: f32,
        /// share of its slot of the alias table that is its own
        accept: f32,
        /// the light that has the rest of the slot
        alias: u32,
        /// position, centre, corner or first vertex
        position: [f32; 3],
        /// radius (0: ellipsoid); -1 if a flat light faces against u × v; half-width of a projection at distance 1; first number of a light of the table
        a: f32,
        /// first edge, second vertex less the first, or direction of a light without extent
        edge_u: [f32; 3],
        /// area of a surface; half-height of a projection at distance 1; second number of a light of the table
        b: f32,
        /// second edge, third vertex less the first, or what is up for the texture of a light without extent
        edge_v: [f32; 3],
        /// 1 when it shines on both sides
        two_sided: u32,
        /// radiance, intensity or irradiance, or a factor on that of its texture
        radiance: [f32; 3],
        /// its texture, or NONE
        texture: u32,
        /// uv of the first vertex of a triangle; x and y of the third axis of a quadric, or of the twist of a patch; third and fourth number of a light of the table
        uv0: [f32; 2],
        /// uv of the second vertex less the first; z of that axis or twist, and the turn of a part
        uv1: [f32; 2],
        /// uv of the third vertex less the first; least and greatest z of a part of a sphere; radius of the hole of a disk
        uv2: [f32; 2],
        /// material of a surface
        material: u32,
        /// triangle: that of its Face, or NONE; LIGHT_TURNED: two corners changed places. point light: 1 for an equal-area map; patch: first word of `instances` with its BilinearPatch
        extra: u32,
    }

    /// A cell of the importance table of the environment (alias method).
    struct EnvironmentCell {
        /// share of the slot that is its own
        accept: f32,
        /// the cell that has the rest
        alias: u32,
        /// chance of the cell
        chance: f32,
        /// room
        spare: u32,
    }
}
