"""The tables that two documents print, reproduced: as published, as reproduced, as exact; and printed solutions."""
