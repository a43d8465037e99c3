"""The Cornell box: nothing in it is hard, and everybody knows how it should look. Its front is open to a black chamber, from
where one looks in."""

from kit import Group, Map
from scene_parts import stand


def block(width: float, height: float) -> Group:
    group = Group()
    group.detail.box((-width / 2, -width / 2, 0), (width / 2, width / 2, height), "lab_white")
    return group


def build() -> Map:
    world = Map("Cornell box")
    sides = {"west": "lab_red", "east": "lab_green", "north": "lab_white", "top": "lab_white", "bottom": "lab_white"}
    world.room((-160, 0, 0), (160, 320, 320), sides | {"south": "lab_black"})
    world.room((-320, -528, -80), (320, -16, 400), "lab_black")
    world.cut((-160, -32, 0), (160, 0, 320))
    world.detail.box((-46, 122, 318), (46, 198, 320), {"all": "lab_black", "bottom": "lab_light_warm"})
    world.add(block(92, 190), (-52, 204, 0), turn=17)
    world.add(block(94, 94), (56, 104, 0), turn=-17)
    stand(world, 0, -400, -80, 90)
    return world
