"""Pictures: of scenes (render), of the functional network (schematic), and the report that shows both."""
