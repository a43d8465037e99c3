"""The classnames that maps for Quake use (what its progs could spawn): each needs a function of its name."""

WORLD = (
    "worldspawn light light_fluoro light_fluorospark light_globe light_torch_small_walltorch light_flame_large_yellow"
)
WORLD += " light_flame_small_yellow light_flame_small_white air_bubbles event_lightning viewthing"
WORLD += " ambient_suck_wind ambient_drone ambient_flouro_buzz ambient_drip ambient_comp_hum ambient_thunder"
WORLD += " ambient_light_buzz ambient_swamp1 ambient_swamp2"
PLACES = "info_player_start info_player_start2 info_player_deathmatch info_player_coop testplayerstart info_null info_notnull"
PLACES += " info_intermission info_teleport_destination path_corner"
MOVERS = "func_door func_door_secret func_button func_plat func_train func_wall func_illusionary func_episodegate"
MOVERS += " func_bossgate misc_teleporttrain"
TRIGGERS = (
    "trigger_multiple trigger_once trigger_relay trigger_secret trigger_counter trigger_teleport trigger_changelevel"
)
TRIGGERS += " trigger_setskill trigger_onlyregistered trigger_hurt trigger_push trigger_monsterjump"
ITEMS = "item_health item_armor1 item_armor2 item_armorInv item_shells item_spikes item_rockets item_cells item_weapon"
ITEMS += " item_key1 item_key2 item_sigil item_artifact_invulnerability item_artifact_envirosuit"
ITEMS += " item_artifact_invisibility item_artifact_super_damage weapon_supershotgun weapon_nailgun weapon_supernailgun"
ITEMS += " weapon_grenadelauncher weapon_rocketlauncher weapon_lightning"
TRAPS = "trap_spikeshooter trap_shooter misc_fireball misc_explobox misc_explobox2 misc_noisemaker"
MONSTERS = "monster_army monster_boss monster_demon1 monster_dog monster_enforcer monster_fish monster_hell_knight"
MONSTERS += " monster_knight monster_ogre monster_ogre_marksman monster_oldone monster_shalrath monster_shambler"
MONSTERS += " monster_tarbaby monster_wizard monster_zombie"

# What maps give to other things by name, in the key `use`.
USED_BY_NAME = "barrel_explode SUB_Null SUB_Remove SUB_UseTargets door_use door_go_up light_use train_use multi_use"

ALL = " ".join([WORLD, PLACES, MOVERS, TRIGGERS, ITEMS, TRAPS, MONSTERS, USED_BY_NAME]).split()
