// SPDX-License-Identifier: GPL-3.0-or-later
// The loop of a program that shows rain on a windshield as it falls: mono rain.exe FRAMES
//   mcs rain.cs
// libdroplet_c.so must be where the system finds libraries, such as by LD_LIBRARY_PATH.
using System;
using System.Runtime.InteropServices;

static class Droplet
{
    [StructLayout(LayoutKind.Sequential)]
    public struct Tile
    {
        public int X, Y, Width, Height;  // [px]
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct Tiles
    {
        public IntPtr List;  // of Tile; stays until the next drawing
        public UIntPtr Count;
    }

    const string kLibrary = "droplet_c";
    [DllImport(kLibrary)] public static extern int droplet_windshield_new(string preset, out IntPtr made);
    [DllImport(kLibrary)] public static extern void droplet_windshield_delete(IntPtr windshield);
    [DllImport(kLibrary)] public static extern int droplet_windshield_set(IntPtr windshield, string name, double value);
    [DllImport(kLibrary)] public static extern int droplet_windshield_advance(IntPtr windshield, double seconds);
    [DllImport(kLibrary)] public static extern UIntPtr droplet_windshield_running(IntPtr windshield, IntPtr droplets, UIntPtr room);
    [DllImport(kLibrary)] public static extern int droplet_windshield_map_height(IntPtr windshield, int width, out int height);
    [DllImport(kLibrary)] public static extern int droplet_windshield_draw(IntPtr windshield, int width, [In, Out] ushort[] pixels, out Tiles tiles);
    [DllImport(kLibrary)] static extern IntPtr droplet_message();

    public static void Check(int code)
    {
        if (code != 0)
        {
            throw new Exception(Marshal.PtrToStringAnsi(droplet_message()));
        }
    }
}

static class Rain
{
    const int kWidth = 1024;

    static int Main(string[] arguments)
    {
        try
        {
            Run(arguments.Length > 0 ? int.Parse(arguments[0]) : 60);
            return 0;
        }
        catch (Exception error)
        {
            Console.Error.WriteLine(error.Message);
            return 2;
        }
    }

    static void Run(int frames)
    {
        Droplet.Check(Droplet.droplet_windshield_new("figure-3.12", out IntPtr rain));
        Droplet.Check(Droplet.droplet_windshield_set(rain, "wiper-period", 1.2));
        Droplet.Check(Droplet.droplet_windshield_map_height(rain, kWidth, out int height));
        // RGBA, half floats: normal x and y times wetness, thickness in mm, wetness.
        var pixels = new ushort[4 * kWidth * height];
        for (int frame = 0; frame < frames; ++frame)
        {
            // A driver's inputs go here: droplet_windshield_set(rain, "speed", 30.0).
            Droplet.Check(Droplet.droplet_windshield_advance(rain, 1.0 / 60.0));
            Droplet.Check(Droplet.droplet_windshield_draw(rain, kWidth, pixels, out Droplet.Tiles tiles));
            // For each tile: upload its pixels; in Unity, texture.Apply(false) uploads all.
            UIntPtr running = Droplet.droplet_windshield_running(rain, IntPtr.Zero, UIntPtr.Zero);
            Console.WriteLine($"{frame}: {running} run, {tiles.Count} tiles changed");
        }
        Droplet.droplet_windshield_delete(rain);
    }
}
