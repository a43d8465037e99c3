#include "net/state_codec.h"

namespace fb::net {

// --- entity states ---------------------------------------------------------------------------------------------------

EntityState read_baseline(MessageReader& r, bool extended) {
  EntityState s;
  const auto bits = extended ? static_cast<std::uint32_t>(r.u8()) : 0u;
  s.model = bits & kBaselineLargeModel ? r.u16() : r.u8();
  s.frame = bits & kBaselineLargeFrame ? r.u16() : r.u8();
  s.colormap = r.u8();
  s.skin = r.u8();
  for (int i = 0; i < 3; ++i) {
    s.origin[i] = r.coord();
    s.angles[i] = r.angle();
  }
  if (bits & kBaselineAlpha) s.alpha = r.u8();
  if (bits & kBaselineScale) s.scale = r.u8();
  return s;
}

void write_baseline(MessageWriter& w, const EntityState& s, bool extended) {
  std::uint32_t bits = 0;
  if (extended) {
    if (s.model > 255) bits |= kBaselineLargeModel;
    if (s.frame > 255) bits |= kBaselineLargeFrame;
    if (s.alpha != kAlphaDefault) bits |= kBaselineAlpha;
    if (s.scale != kScaleDefault) bits |= kBaselineScale;
    w.u8(static_cast<int>(bits));
  }
  if (bits & kBaselineLargeModel)
    w.u16(s.model);
  else
    w.u8(s.model);
  if (bits & kBaselineLargeFrame)
    w.u16(s.frame);
  else
    w.u8(s.frame);
  w.u8(s.colormap);
  w.u8(s.skin);
  for (int i = 0; i < 3; ++i) {
    w.coord(s.origin[i]);
    w.angle(s.angles[i]);
  }
  if (bits & kBaselineAlpha) w.u8(s.alpha);
  if (bits & kBaselineScale) w.u8(s.scale);
}

svc::EntityUpdate read_update(MessageReader& r, unsigned command) {
  svc::EntityUpdate u;
  std::uint32_t bits = command & 127u;
  if (bits & kUpdateMoreBits) bits |= static_cast<std::uint32_t>(r.u8()) << 8;
  const bool extended = r.protocol.extended();
  if (extended) {
    if (bits & kUpdateExtend1) bits |= static_cast<std::uint32_t>(r.u8()) << 16;
    if (bits & kUpdateExtend2) bits |= static_cast<std::uint32_t>(r.u8()) << 24;
  }
  u.entity = bits & kUpdateLongEntity ? r.i16() : r.u8();
  if (bits & kUpdateModel) u.model = r.u8();
  if (bits & kUpdateFrame) u.frame = r.u8();
  if (bits & kUpdateColormap) u.colormap = r.u8();
  if (bits & kUpdateSkin) u.skin = r.u8();
  if (bits & kUpdateEffects) u.effects = r.u8();
  if (bits & kUpdateOrigin1) u.origin.x = r.coord();
  if (bits & kUpdateAngle1) u.angles.x = r.angle();
  if (bits & kUpdateOrigin2) u.origin.y = r.coord();
  if (bits & kUpdateAngle2) u.angles.y = r.angle();
  if (bits & kUpdateOrigin3) u.origin.z = r.coord();
  if (bits & kUpdateAngle3) u.angles.z = r.angle();
  if (extended) {
    if (bits & kUpdateAlpha) u.alpha = r.u8();
    if (bits & kUpdateScale) u.scale = r.u8();
    if (bits & kUpdateFrame2) u.frame |= r.u8() << 8;
    if (bits & kUpdateModel2) u.model |= r.u8() << 8;
    if (bits & kUpdateLerpFinish) u.lerp_finish = r.u8();
  } else if (bits & kUpdateExtend1) {
    // Nehahra's dialect of protocol 15: a float that is 2 when a third one (fullbright) follows, and alpha as a float.
    const float kind = r.f32();
    u.alpha = encode_alpha(glm::clamp(r.f32(), 0.0f, 1.0f));
    if (kind == 2.0f) r.f32();
    bits = (bits & ~kUpdateExtend1) | kUpdateAlpha;
  }
  u.bits = bits;
  return u;
}

void write_update(MessageWriter& w, const svc::EntityUpdate& u) {
  constexpr std::uint32_t kShape = kUpdateMoreBits | kUpdateSignal | kUpdateLongEntity | kUpdateExtend1 |
                                   kUpdateExtend2 | kUpdateFrame2 | kUpdateModel2;
  constexpr std::uint32_t kExtendedFields = kUpdateAlpha | kUpdateLerpFinish | kUpdateScale;
  std::uint32_t bits = u.bits & ~kShape;
  const bool extended = w.protocol.extended();
  if (!extended) bits &= 0x7fffu;
  if (extended) {
    // With the high byte alone, the low byte would be the baseline's: both are sent.
    if ((bits & kUpdateFrame) && u.frame > 255) bits |= kUpdateFrame2;
    if ((bits & kUpdateModel) && u.model > 255) bits |= kUpdateModel2;
    if (bits & (kExtendedFields | kUpdateFrame2 | kUpdateModel2)) bits |= kUpdateExtend1;
  }
  if (u.entity > 255) bits |= kUpdateLongEntity;
  if (bits > 255) bits |= kUpdateMoreBits;
  w.u8(static_cast<int>((bits & 127u) | kUpdateSignal));
  if (bits & kUpdateMoreBits) w.u8(static_cast<int>(bits >> 8));
  if (bits & kUpdateExtend1) w.u8(static_cast<int>(bits >> 16));
  if (bits & kUpdateLongEntity)
    w.i16(u.entity);
  else
    w.u8(u.entity);
  if (bits & kUpdateModel) w.u8(u.model);
  if (bits & kUpdateFrame) w.u8(u.frame);
  if (bits & kUpdateColormap) w.u8(u.colormap);
  if (bits & kUpdateSkin) w.u8(u.skin);
  if (bits & kUpdateEffects) w.u8(u.effects);
  if (bits & kUpdateOrigin1) w.coord(u.origin.x);
  if (bits & kUpdateAngle1) w.angle(u.angles.x);
  if (bits & kUpdateOrigin2) w.coord(u.origin.y);
  if (bits & kUpdateAngle2) w.angle(u.angles.y);
  if (bits & kUpdateOrigin3) w.coord(u.origin.z);
  if (bits & kUpdateAngle3) w.angle(u.angles.z);
  if (bits & kUpdateAlpha) w.u8(u.alpha);
  if (bits & kUpdateScale) w.u8(u.scale);
  if (bits & kUpdateFrame2) w.u8(u.frame >> 8);
  if (bits & kUpdateModel2) w.u8(u.model >> 8);
  if (bits & kUpdateLerpFinish) w.u8(u.lerp_finish);
}

// --- client data -----------------------------------------------------------------------------------------------------

svc::ClientData read_client_data(MessageReader& r) {
  svc::ClientData d;
  auto bits = static_cast<std::uint32_t>(r.u16());
  if (bits & kDataExtend1) bits |= static_cast<std::uint32_t>(r.u8()) << 16;
  if (bits & kDataExtend2) bits |= static_cast<std::uint32_t>(r.u8()) << 24;
  if (bits & kDataViewHeight) d.view_height = r.i8();
  if (bits & kDataIdealPitch) d.ideal_pitch = r.i8();
  for (std::uint32_t i = 0; i < 3; ++i) {
    if (bits & (kDataPunch1 << i)) d.punch[i] = r.i8();
    if (bits & (kDataVelocity1 << i)) d.velocity[i] = r.i8();
  }
  d.items = r.i32();
  d.on_ground = bits & kDataOnGround;
  d.in_water = bits & kDataInWater;
  d.on_elevator = bits & kDataOnElevator;
  if (bits & kDataWeaponFrame) d.weapon_frame = r.u8();
  if (bits & kDataArmor) d.armor = r.u8();
  if (bits & kDataWeapon) d.weapon = r.u8();
  d.health = r.i16();
  d.ammo = r.u8();
  for (int& count : d.ammo_counts) count = r.u8();
  d.active_weapon = r.u8();
  if (bits & kDataWeapon2) d.weapon |= r.u8() << 8;
  if (bits & kDataArmor2) d.armor |= r.u8() << 8;
  if (bits & kDataAmmo2) d.ammo |= r.u8() << 8;
  for (std::uint32_t i = 0; i < 4; ++i)
    if (bits & (kDataShells2 << i)) d.ammo_counts[i] |= r.u8() << 8;
  if (bits & kDataWeaponFrame2) d.weapon_frame |= r.u8() << 8;
  if (bits & kDataWeaponAlpha) d.weapon_alpha = r.u8();
  return d;
}

void write_client_data(MessageWriter& w, const svc::ClientData& d) {
  std::uint32_t bits = kDataItems;
  if (d.view_height != kDefaultViewHeight) bits |= kDataViewHeight;
  if (d.ideal_pitch) bits |= kDataIdealPitch;
  for (std::uint32_t i = 0; i < 3; ++i) {
    if (d.punch[i]) bits |= kDataPunch1 << i;
    if (d.velocity[i]) bits |= kDataVelocity1 << i;
  }
  if (d.on_ground) bits |= kDataOnGround;
  if (d.in_water) bits |= kDataInWater;
  if (d.weapon_frame) bits |= kDataWeaponFrame;
  if (d.armor) bits |= kDataArmor;
  if (d.weapon) bits |= kDataWeapon;
  if (w.protocol.extended()) {
    if (d.weapon > 255) bits |= kDataWeapon2;
    if (d.armor > 255) bits |= kDataArmor2;
    if (d.ammo > 255) bits |= kDataAmmo2;
    for (std::uint32_t i = 0; i < 4; ++i)
      if (d.ammo_counts[i] > 255) bits |= kDataShells2 << i;
    if (d.weapon_frame > 255) bits |= kDataWeaponFrame2;
    if (d.weapon_alpha != kAlphaDefault) bits |= kDataWeaponAlpha;
    if (d.on_elevator) bits |= kDataOnElevator;
    if (bits >> 24) bits |= kDataExtend2;
    if (bits >> 16) bits |= kDataExtend1;
  }
  w.u16(static_cast<int>(bits & 0xffffu));
  if (bits & kDataExtend1) w.u8(static_cast<int>(bits >> 16));
  if (bits & kDataExtend2) w.u8(static_cast<int>(bits >> 24));
  if (bits & kDataViewHeight) w.i8(d.view_height);
  if (bits & kDataIdealPitch) w.i8(d.ideal_pitch);
  for (std::uint32_t i = 0; i < 3; ++i) {
    if (bits & (kDataPunch1 << i)) w.i8(d.punch[i]);
    if (bits & (kDataVelocity1 << i)) w.i8(d.velocity[i]);
  }
  w.i32(d.items);
  if (bits & kDataWeaponFrame) w.u8(d.weapon_frame);
  if (bits & kDataArmor) w.u8(d.armor);
  if (bits & kDataWeapon) w.u8(d.weapon);
  w.i16(d.health);
  w.u8(d.ammo);
  for (int count : d.ammo_counts) w.u8(count);
  w.u8(d.active_weapon);
  if (bits & kDataWeapon2) w.u8(d.weapon >> 8);
  if (bits & kDataArmor2) w.u8(d.armor >> 8);
  if (bits & kDataAmmo2) w.u8(d.ammo >> 8);
  for (std::uint32_t i = 0; i < 4; ++i)
    if (bits & (kDataShells2 << i)) w.u8(d.ammo_counts[i] >> 8);
  if (bits & kDataWeaponFrame2) w.u8(d.weapon_frame >> 8);
  if (bits & kDataWeaponAlpha) w.u8(d.weapon_alpha);
}

// --- sounds ----------------------------------------------------------------------------------------------------------

svc::Sound read_sound(MessageReader& r) {
  svc::Sound s;
  const auto bits = static_cast<std::uint32_t>(r.u8());
  if (bits & kSoundVolume) s.volume = r.u8();
  if (bits & kSoundAttenuation) s.attenuation = r.u8();
  if (bits & kSoundLargeEntity) {
    s.entity = r.u16();
    s.channel = r.u8();
  } else {
    const int both = r.u16();
    s.entity = both >> 3;
    s.channel = both & 7;
  }
  s.sound = bits & kSoundLargeSound ? r.u16() : r.u8();
  s.origin = r.coords();
  return s;
}

void write_sound(MessageWriter& w, const svc::Sound& s) {
  std::uint32_t bits = 0;
  if (s.volume != 255) bits |= kSoundVolume;
  if (s.attenuation != 64) bits |= kSoundAttenuation;
  if (w.protocol.extended()) {
    if (s.entity >= 8192 || s.channel >= 8) bits |= kSoundLargeEntity;
    if (s.sound > 255) bits |= kSoundLargeSound;
  }
  w.u8(static_cast<int>(bits));
  if (bits & kSoundVolume) w.u8(s.volume);
  if (bits & kSoundAttenuation) w.u8(s.attenuation);
  if (bits & kSoundLargeEntity) {
    w.u16(s.entity);
    w.u8(s.channel);
  } else {
    w.u16((s.entity << 3) | (s.channel & 7));
  }
  if (bits & kSoundLargeSound)
    w.u16(s.sound);
  else
    w.u8(s.sound);
  w.coords(s.origin);
}

}  // namespace fb::net
