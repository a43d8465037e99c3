"""The sounds that Quake's engine, its game code and maps name: paths, how long each may be, and which of them loop.

These are facts that other games' code and models rely on: a nail gun calls its sound ten times a second, a door stops
its moving sound by playing another, an ambient that does not loop is refused. Seconds are what the moment in the game
leaves room for. A looped sound repeats from its loop point on until something else is played.
"""

from __future__ import annotations

from dataclasses import dataclass

# category: loudness that its sounds are brought to (dB below full scale, see kit/master.py), how far each may be off it
CATEGORIES = {
    "blast": (-10.5, 2.5),
    "weapon": (-13.0, 2.5),
    "impact": (-17.0, 3.0),
    "voice": (-15.0, 2.5),
    "idle": (-19.5, 2.5),
    "player": (-16.5, 2.5),
    "pickup": (-18.0, 2.5),
    "signal": (-17.5, 2.5),
    "mover": (-20.0, 2.5),
    "button": (-19.0, 3.0),
    "water": (-19.0, 2.5),
    "menu": (-21.0, 3.0),
    "ambience": (-26.0, 2.5),
    "silence": (-120.0, 120.0),
}

# name without sound/ and .wav, category, seconds at least and at most, "loop" where it loops
_TABLE = """
ambience/buzz1      ambience 3 8 loop
ambience/comp1      ambience 3 8 loop
ambience/drip1      ambience 5 14 loop
ambience/drone6     ambience 3 10 loop
ambience/fire1      ambience 3 8 loop
ambience/fl_hum1    ambience 3 8 loop
ambience/hum1       ambience 3 12 loop
ambience/suck1      ambience 3 10 loop
ambience/swamp1     ambience 4 12 loop
ambience/swamp2     ambience 4 12 loop
ambience/thunder1   ambience 6 16 loop
ambience/water1     ambience 4 10 loop
ambience/wind2      ambience 6 32 loop
ambience/windfly    water    1 2.5
blob/death1         voice    0.7 2.5
blob/hit1           impact   0.3 1.2
blob/land1          impact   0.25 1
blob/sight1         voice    0.8 2.6
boss1/death         voice    2 4
boss1/out1          voice    1 3
boss1/pain          voice    0.8 2
boss1/sight1        voice    1.5 4.8
boss1/throw         weapon   0.4 1.2
boss2/death         voice    2 5
boss2/idle          idle     1.5 4
boss2/pop2          blast    0.5 2
boss2/sight         voice    1.5 4
buttons/airbut1     button   0.3 1.4
buttons/switch02    button   0.3 1.2
buttons/switch04    button   0.3 1.2
buttons/switch21    button   0.3 1.2
demon/ddeath        voice    1 2.2
demon/dhit2         impact   0.25 0.7
demon/djump         voice    0.5 1.4
demon/dland2        impact   0.3 1
demon/dpain1        voice    0.4 1.4
demon/idle1         idle     0.8 2.5
demon/sight2        voice    0.8 2.2
dog/dattack1        voice    0.4 1.6
dog/ddeath          voice    0.5 1.5
dog/dpain1          voice    0.3 1.3
dog/dsight          voice    0.5 1.5
dog/idle            idle     0.8 2
doors/airdoor1      mover    1 5 loop
doors/airdoor2      mover    0.4 2.5
doors/basesec1      mover    0.8 3 loop
doors/basesec2      mover    0.4 1.5
doors/basetry       signal   0.4 1
doors/baseuse       signal   0.3 1
doors/ddoor1        mover    0.6 3 loop
doors/ddoor2        mover    0.3 1.2
doors/doormv1       mover    1.5 4 loop
doors/drclos4       mover    0.4 2.4
doors/hydro1        mover    1 3 loop
doors/hydro2        mover    0.4 1.2
doors/latch2        mover    0.3 1.2
doors/medtry        signal   0.4 1.6
doors/meduse        signal   0.5 1.8
doors/runetry       signal   0.6 2.6
doors/runeuse       signal   0.6 1.8
doors/stndr1        mover    1.5 4 loop
doors/stndr2        mover    0.5 2.7
doors/winch2        mover    1 3 loop
enforcer/death1     voice    0.8 2.8
enforcer/enfire     weapon   0.3 1
enforcer/enfstop    impact   0.3 1
enforcer/idle1      idle     1 2.8
enforcer/pain1      voice    0.3 1.8
enforcer/pain2      voice    0.3 1.8
enforcer/sight1     voice    0.6 2.8
enforcer/sight2     voice    0.6 2.8
enforcer/sight3     voice    0.6 2.8
enforcer/sight4     voice    0.6 2.8
fish/bite           impact   0.25 1
fish/death          voice    0.6 1.5
fish/idle           idle     0.6 1.6
hknight/attack1     weapon   0.3 1.2
hknight/death1      voice    1 2
hknight/grunt       voice    0.3 0.9
hknight/hit         impact   0.3 0.9
hknight/idle        idle     1 2.2
hknight/pain1       voice    0.4 1.2
hknight/sight1      voice    1 3
hknight/slash1      weapon   0.2 0.7
items/armor1        pickup   0.3 1
items/damage        signal   1 2.6
items/damage2       signal   1 3
items/damage3       weapon   0.4 1.2
items/health1       pickup   0.25 0.8
items/inv1          signal   1 2.6
items/inv2          signal   1 3
items/inv3          signal   1 3
items/itembk2       signal   0.4 1
items/protect       signal   1 2.6
items/protect2      signal   1 3
items/protect3      impact   0.4 2.2
items/r_item1       pickup   0.25 0.8
items/r_item2       pickup   0.5 1.2
items/suit          signal   1 2.6
items/suit2         signal   1 3.5
knight/idle         idle     0.8 2
knight/kdeath       voice    0.8 1.6
knight/khurt        voice    0.3 1
knight/ksight       voice    0.7 1.5
knight/sword1       weapon   0.2 0.6
knight/sword2       weapon   0.2 0.6
misc/basekey        pickup   0.4 1
misc/h2ohit1        water    0.4 1.1
misc/medkey         pickup   0.5 1.7
misc/menu1          menu     0.05 0.3
misc/menu2          menu     0.1 0.6
misc/menu3          menu     0.03 0.3
misc/null           silence  0.02 0.2
misc/outwater       water    0.4 1.2
misc/power          signal   0.8 2.4
misc/r_tele1        signal   0.6 1.9
misc/r_tele2        signal   0.6 1.9
misc/r_tele3        signal   0.6 1.9
misc/r_tele4        signal   0.6 1.9
misc/r_tele5        signal   0.6 1.9
misc/runekey        pickup   0.6 1.6
misc/secret         signal   0.8 2
misc/talk           menu     0.1 0.5
misc/trigger1       signal   0.5 1.7
misc/water1         water    0.4 1.2
misc/water2         water    0.4 1.2
ogre/ogdrag         idle     0.6 1.2
ogre/ogdth          voice    1 2.2
ogre/ogidle         idle     0.8 1.8
ogre/ogidle2        idle     0.8 1.8
ogre/ogpain1        voice    0.5 1.3
ogre/ogsawatk       weapon   0.5 1.2
ogre/ogwake         voice    0.7 1.5
plats/medplat1      mover    0.5 3 loop
plats/medplat2      mover    0.4 1.2
plats/plat1         mover    0.5 3 loop
plats/plat2         mover    0.4 1.2
plats/train1        mover    0.8 3 loop
plats/train2        mover    0.4 1.2
player/axhit1       impact   0.15 0.6
player/axhit2       impact   0.2 0.6
player/death1       player   0.5 1.8
player/death2       player   0.5 1.8
player/death3       player   0.5 1.8
player/death4       player   0.5 1.8
player/death5       player   0.5 1.8
player/drown1       player   0.4 1.2
player/drown2       player   0.4 1.2
player/gasp1        player   0.4 1.2
player/gasp2        player   0.5 1.6
player/gib          impact   0.5 1.7
player/h2odeath     player   0.8 2.4
player/h2ojump      water    0.3 1.2
player/inh2o        water    0.4 1.2
player/inlava       water    0.5 1.5
player/land         impact   0.12 0.5
player/land2        impact   0.2 0.8
player/lburn1       water    0.4 1.2
player/lburn2       water    0.4 1.2
player/pain1        player   0.2 0.8
player/pain2        player   0.2 0.8
player/pain3        player   0.2 0.8
player/pain4        player   0.2 0.8
player/pain5        player   0.2 0.8
player/pain6        player   0.2 0.8
player/plyrjmp8     player   0.15 0.4
player/slimbrn2     water    0.4 1.2
player/slmbrn2      water    0.4 1.2
player/teledth1     impact   0.5 1.6
player/tornoff2     impact   0.3 1
player/udeath       impact   0.5 1.6
shalrath/attack     voice    0.6 1.4
shalrath/attack2    weapon   0.4 1
shalrath/death      voice    1 2
shalrath/idle       idle     0.8 1.8
shalrath/pain       voice    0.5 1.7
shalrath/sight      voice    0.8 1.9
shambler/melee1     weapon   0.3 0.8
shambler/melee2     weapon   0.3 0.8
shambler/sattck1    weapon   0.8 1.4
shambler/sboom      blast    0.7 1.6
shambler/sdeath     voice    1 2.6
shambler/shurt2     voice    0.6 1.4
shambler/sidle      idle     1 2
shambler/smack      impact   0.3 1.1
shambler/ssight     voice    1 2.2
soldier/death1      voice    0.6 1.7
soldier/idle        idle     0.7 1.6
soldier/pain1       voice    0.3 1.3
soldier/pain2       voice    0.3 1.3
soldier/sattck1     weapon   0.4 1.3
soldier/sight1      voice    0.4 1.2
weapons/ax1         weapon   0.15 0.5
weapons/bounce      impact   0.2 0.6
weapons/grenade     weapon   0.3 0.9
weapons/guncock     weapon   0.4 1.3
weapons/lhit        weapon   0.4 0.7
weapons/lock4       pickup   0.2 0.5
weapons/lstart      weapon   0.4 1.3
weapons/pkup        pickup   0.3 0.7
weapons/r_exp3      blast    0.8 2
weapons/ric1        impact   0.25 1
weapons/ric2        impact   0.25 1
weapons/ric3        impact   0.25 1
weapons/rocket1i    weapon   0.15 1
weapons/sgun1       weapon   0.5 1.4
weapons/shotgn2     weapon   0.5 1.4
weapons/spike2      weapon   0.15 0.8
weapons/tink1       impact   0.08 0.3
wizard/hit          impact   0.3 0.8
wizard/wattack      voice    0.6 2
wizard/wdeath       voice    0.8 1.6
wizard/widle1       idle     1 3.7
wizard/widle2       idle     0.8 2
wizard/wpain        voice    0.3 1
wizard/wsight       voice    0.6 1.5
zombie/idle_w2      idle     0.8 2
zombie/z_fall       impact   0.3 0.8
zombie/z_gib        impact   0.5 1.4
zombie/z_hit        impact   0.25 0.8
zombie/z_idle       idle     0.8 2.2
zombie/z_idle1      idle     0.8 2.8
zombie/z_miss       impact   0.25 0.8
zombie/z_pain       voice    0.4 1.2
zombie/z_pain1      voice    0.4 1.4
zombie/z_shot1      weapon   0.2 0.6
"""


@dataclass(frozen=True)
class Convention:
    """What is known of one sound before it is made."""

    name: str  # below sound/, without .wav
    category: str
    shortest: float  # seconds
    longest: float
    looped: bool

    @property
    def path(self) -> str:
        return f"sound/{self.name}.wav"

    @property
    def loudness(self) -> float:
        return CATEGORIES[self.category][0]


def _read() -> dict[str, Convention]:
    out = {}
    for line in _TABLE.split("\n"):
        words = line.split()
        if words:
            out[words[0]] = Convention(words[0], words[1], float(words[2]), float(words[3]), words[4:] == ["loop"])
    return out


CONVENTIONS = _read()
