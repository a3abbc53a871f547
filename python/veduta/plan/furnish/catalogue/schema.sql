-- The catalogue of objects. A file of a user's own has the same tables; only `object` is needed.
-- Lengths are in metres. Frame of an object: x to the right as one looks at its front, y to its back,
-- z up; its front looks to -y.

CREATE TABLE IF NOT EXISTS object (
  name TEXT PRIMARY KEY,             -- unique, as in plan.json
  type TEXT NOT NULL,                -- what it is: objects of a type may stand for each other
  class TEXT NOT NULL CHECK (class IN ('seat', 'table', 'bed', 'storage', 'kitchen', 'appliance',
    'sanitary', 'lamp', 'plant', 'textile', 'decoration', 'screen', 'vehicle', 'works')),
  model TEXT,                        -- a builder of the project, or
  file TEXT,                         -- a GLB file beside the catalogue: y up, its front to +z
  finishes TEXT NOT NULL DEFAULT '', -- what its parts are made of: 'legs=oak fabric=linen'
  width_m REAL NOT NULL CHECK (width_m > 0),
  depth_m REAL NOT NULL CHECK (depth_m > 0),
  height_m REAL NOT NULL CHECK (height_m > 0),
  least_width_m REAL,                -- NULL: it comes in this width only
  most_width_m REAL,
  least_depth_m REAL,
  most_depth_m REAL,
  walls TEXT NOT NULL DEFAULT 'back',  -- sides that may stand against a wall: back, left, right
  stands TEXT NOT NULL DEFAULT 'floor' CHECK (stands IN ('floor', 'wall', 'things')),
  above_m REAL NOT NULL DEFAULT 0,   -- from the floor to its base, where it hangs on a wall
  front_m REAL NOT NULL DEFAULT 0,   -- what must stay free before it
  side_m REAL NOT NULL DEFAULT 0,    -- the least distance to what stands beside it
  fragility INTEGER NOT NULL DEFAULT 0 CHECK (fragility BETWEEN 0 AND 2),
  CHECK ((model IS NULL) <> (file IS NULL))
);

-- Where other things may stand on an object, as shares of its width, depth and height from its
-- left, front and base.
CREATE TABLE IF NOT EXISTS surface (
  object TEXT NOT NULL REFERENCES object (name),
  left REAL NOT NULL, right REAL NOT NULL, front REAL NOT NULL, back REAL NOT NULL,
  height REAL NOT NULL,
  free_m REAL NOT NULL DEFAULT 1.0,  -- how high things on it may be
  fragility INTEGER NOT NULL DEFAULT 2  -- the most fragile things that may stand there
);

-- What a room of a use has, in the order in which it is placed.
CREATE TABLE IF NOT EXISTS wanted (
  use TEXT NOT NULL,
  type TEXT NOT NULL,
  least INTEGER NOT NULL DEFAULT 1,
  most INTEGER NOT NULL DEFAULT 1,
  from_m2 REAL NOT NULL DEFAULT 0,   -- in rooms of this area and more
  each_m2 REAL NOT NULL DEFAULT 1000 CHECK (each_m2 > 0),  -- one more for each so many square metres
  chance REAL NOT NULL DEFAULT 1.0,
  critical INTEGER NOT NULL DEFAULT 0,  -- others make room for it
  place INTEGER NOT NULL             -- order in the room
);

-- What takes the place of a type for which there is no room.
CREATE TABLE IF NOT EXISTS smaller (type TEXT PRIMARY KEY, instead TEXT NOT NULL);

-- What parts are made of: sRGB, glTF's roughness and metalness, a built-in texture.
CREATE TABLE IF NOT EXISTS finish (
  name TEXT PRIMARY KEY,
  red REAL NOT NULL, green REAL NOT NULL, blue REAL NOT NULL,
  roughness REAL NOT NULL DEFAULT 0.8,
  metalness REAL NOT NULL DEFAULT 0,
  opacity REAL NOT NULL DEFAULT 1,
  texture TEXT
);
