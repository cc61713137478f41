/* The header is C99, and the structs that hosts were compiled with are what they were: fields are only added
 * at the ends. A line here changes only together with AGI_VERSION_MAJOR. */
#include <afterglow/afterglow_gi.h>

#define EXPECT(name, is) typedef char expect_##name[(is) ? 1 : -1]
#define LAST(Type, field, at) EXPECT(Type##_##field, offsetof(Type, field) == (at))

/* The last field of version 1.0 and where it is. */
LAST(AgiRequirements, features, 32);
LAST(AgiMemoryPiece, owner, 24);
LAST(AgiContextInfo, user, 88);
LAST(AgiMemory, blockBytes, 24);
LAST(AgiMaterial, doubleSided, 56);
LAST(AgiMesh, indices, 120);
LAST(AgiInstance, linear, 56);
LAST(AgiLight, mapSize, 96);
LAST(AgiProbe, normal, 32);
LAST(AgiReading, bounced, 12);
LAST(AgiViewInfo, preset, 24);
LAST(AgiOption, most, 56);
LAST(AgiImage, format, 16);
LAST(AgiFrame, timed, 332);
LAST(AgiPass, reason, 16);
LAST(AgiStatus, settled, 20);

/* Structs without structSize: hosts make arrays of them, so they never grow. */
EXPECT(AgiMemoryPiece, sizeof(AgiMemoryPiece) == 32);
EXPECT(AgiProbe, sizeof(AgiProbe) == 48);
EXPECT(AgiReading, sizeof(AgiReading) == 24);
EXPECT(AgiImage, sizeof(AgiImage) == 24);
EXPECT(AgiPass, sizeof(AgiPass) == 24);
