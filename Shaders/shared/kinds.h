// Kinds of things in a scene, which the host writes and shaders read: once, for scene/assets.h, scene/snapshot.h and
// Shaders/lib.
#ifndef FB_SHARED_KINDS_H
#define FB_SHARED_KINDS_H
#include "shared/common.h"
FB_NAMESPACE_BEGIN

// Which rays meet an instance: bits (scene::Visibility).
FB_CONST uint kMaskCamera = 1u;
FB_CONST uint kMaskIndirect = 2u;  // bounces, shadows

// GpuMaterial::flags (scene::MaterialFlags).
FB_CONST uint kMaterialAlphaTest = 1u;      // palette index 255 (or alpha < 0.5) is a hole
FB_CONST uint kMaterialWarp = 2u;           // liquid: texture coordinates swing with time as Quake's warp does
FB_CONST uint kMaterialLiquid = 4u;         // a liquid's surface (r_wateralpha and its kin)
FB_CONST uint kMaterialNoFullbright = 8u;   // indices 224..255 are plain colours
FB_CONST uint kMaterialClampTexture = 16u;  // skins and sprites: texture coordinates do not wrap
FB_CONST uint kMaterialDielectric =
    32u;  // a smooth interface: of a clear liquid (with kMaterialLiquid; r_water), of glass (r_glass)

// How textures are looked up (r_texture_filter).
FB_CONST uint kFilterNearest = 0u;
FB_CONST uint kFilterBilinear = 1u;   // of the four texels about the point
FB_CONST uint kFilterFootprint = 2u;  // the mean over the pixel, by a point in each of its quarters

// GpuMaterial::emission_kind (scene::EmissionKind).
FB_CONST uint kEmissionNone = 0u;        // does not glow
FB_CONST uint kEmissionFullbright = 1u;  // palette indices 224..255 of base, or the texels of `luma`
FB_CONST uint kEmissionLava = 2u;
FB_CONST uint kEmissionSlime = 3u;
FB_CONST uint kEmissionTeleport = 4u;
FB_CONST uint kEmissionSky = 5u;  // radiance comes from the sky by direction
FB_CONST uint kEmissionSprite = 6u;
FB_CONST uint kEmissionParticle = 7u;
FB_CONST uint kEmissionDynamicLight = 8u;
FB_CONST uint kEmissionEntityLight = 9u;
FB_CONST uint kEmissionConstant = 10u;  // the material's emission as it is, never scaled: tests and laboratory scenes
FB_CONST uint kEmissionKinds = 11u;

// Whether every texel of the base image glows.
FB_FN bool all_texels_glow(uint emission_kind) {
  return (emission_kind >= kEmissionLava && emission_kind <= kEmissionTeleport) || emission_kind == kEmissionSprite;
}

// GpuImage::encoding (scene::ImageEncoding).
FB_CONST uint kEncodingPalette = 0u;  // one byte a texel: index into the palette
FB_CONST uint kEncodingSrgba = 1u;    // four bytes: sRGB colour, linear alpha
FB_CONST uint kEncodingLinear = 2u;   // four bytes, linear: normal maps (xyz in 0..255)
FB_CONST uint kEncodingGray = 3u;     // one byte, linear: gloss
FB_CONST uint kEncodingWords = 4u;    // four bytes that are no colour: a table beside the images (shared/gain_field.h)
FB_CONST uint kPaletteSrgb = 256u;    // behind the palette's colours: what each byte of sRGB means

// FrameConstants::sky_mode (scene::SkyMode).
FB_CONST uint kSkyBlack = 0u;
FB_CONST uint kSkyConstant = 1u;
FB_CONST uint kSkyLayers = 2u;
FB_CONST uint kSkyBox = 3u;

// What a scene's surfaces and its sky have (kSpecFeatures): shaders leave out the rest. On lavapipe a branch that no
// lane takes costs as much as one that is taken.
FB_CONST uint kFeatureSmooth = 1u;       // vertex normals
FB_CONST uint kFeatureDetail = 2u;       // normal maps or gloss images
FB_CONST uint kFeatureLuma = 4u;         // images of what glows
FB_CONST uint kFeatureWarp = 8u;         // liquids that swing
FB_CONST uint kFeatureSkyTexture = 16u;  // layers or a box
FB_CONST uint kFeatureSuns = 32u;
FB_CONST uint kFeatureSkins = 64u;  // interfaces of which a share is opaque
FB_CONST uint kFeaturesAll = 127u;

FB_NAMESPACE_END
#endif
