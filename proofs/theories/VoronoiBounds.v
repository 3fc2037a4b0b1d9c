(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Error bound for the partial Voronoi diagram: every undetermined point is near the true diagram. *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane Finite Distance Cells Neighbours Bounds.
Open Scope R_scope.

(* The true diagram of a choice: points with two different nearest points. *)
Definition diagram (N : nat) (p : nat -> point) (z : point) : Prop :=
  exists i j, (i < N)%nat /\ (j < N)%nat /\ p i <> p j /\ cell N p i z /\ cell N p j z.

(* The undetermined set: the points in no Int. *)
Definition undetermined (N : nat) (B : sites) (z : point) : Prop := forall i, (i < N)%nat -> ~ int N B i z.

(* The true diagram is undetermined, for every choice: the undetermined area bounds it, and the rest of a window when
   sets inside the cells Int are taken away bounds the undetermined area. *)
Theorem diagram_is_undetermined N B p z : choice N B p -> diagram N p z -> undetermined N B z.
Proof.
  intros P [i [j [I [J [D [Ci Cj]]]]]] k K H. assert (Dij : i <> j) by (now intros ->). pose proof (proj1 (int_exact N B k z K) H p P) as O.
  destruct (Nat.eq_dec i k) as [-> | Dk].
  - pose proof (O j J (not_eq_sym Dij)). pose proof (Cj k K). lra.
  - pose proof (O i I Dk). pose proof (Ci k K). lra.
Qed.

Theorem undetermined_in_rest N B (inner : nat -> point -> Prop) z :
  (forall i w, (i < N)%nat -> inner i w -> int N B i w) ->
  undetermined N B z -> ~ exists i, (i < N)%nat /\ inner i z.
Proof. intros H U [i [I W]]. now apply (U i I), H. Qed.

Theorem undetermined_monotone N B' B z : refined N B' B -> undetermined N B' z -> undetermined N B z.
Proof. intros F U i I H. apply (U i I). now apply (int_monotone N B' B). Qed.

(* Moving from a point of p i's cell to a point that is at least as near to p j meets the diagram. *)
Lemma way_meets_diagram N p i j z y : (i < N)%nat -> (j < N)%nat -> p j <> p i -> cell N p i z ->
  dist y (p j) <= dist y (p i) -> exists t, 0 <= t <= 1 /\ diagram N p (mix t z y).
Proof.
  intros I J D C Y.
  set (f k t := dist (mix t z y) (p i) - dist (mix t z y) (p k)).
  assert (Cf : forall k, continuity (f k)).
  { intros k. apply (lipschitz_continuous (dist z y + dist z y)). apply lipschitz_minus; apply lipschitz_dist. }
  (* for each k that is nearer at the end: the place where it is as near as i *)
  set (wins k := dist y (p k) <= dist y (p i)).
  set (ends k t := 0 <= t <= 1 /\ (wins k -> f k t = 0)).
  destruct (finite_choice 0 ends N) as [t T].
  { intros k K. destruct (classic (wins k)) as [W | W].
    - destruct (intermediate (f k) (Cf k)) as [t [T E]].
      + unfold f. rewrite mix_0. pose proof (C k K). lra.
      + unfold f. rewrite mix_1. unfold wins in W. lra.
      + exists t. now split.
    - exists 0. split; [lra |]. now intros. }
  destruct (finite_min (fun k => p k <> p i /\ wins k) t N) as [m [M [[Dm Wm] L]]]; [now exists j |].
  destruct (T m M) as [Tm Em]. specialize (Em Wm). exists (t m). split; [exact Tm |].
  assert (A : cell N p i (mix (t m) z y)).
  { intros k K. destruct (classic (p k = p i)) as [-> | Dk]; [lra |]. destruct (classic (wins k)) as [W | W].
    - pose proof (L k K (conj Dk W)) as Lk. destruct (T k K) as [Tk Ek]. specialize (Ek W).
      destruct (Req_dec (t k) 0) as [Z | Z].
      + replace (t m) with 0 by lra. rewrite mix_0. now apply C.
      + replace (mix (t m) z y) with (mix (t m / t k) z (mix (t k) z y)).
        * apply nearer_convex_weak; [| now apply C | unfold f in Ek; lra]. split.
          -- apply Rmult_le_pos; [lra |]. left. apply Rinv_0_lt_compat. lra.
          -- apply (Rmult_le_reg_r (t k)); [lra |]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra.
        * unfold mix. simpl. f_equal; field; exact Z.
    - apply nearer_convex_weak; [exact Tm | now apply C |]. unfold wins in W. lra. }
  exists i, m. repeat split; [exact I | exact M | now apply not_eq_sym | exact A |].
  intros k K. pose proof (A k K). unfold f in Em. lra.
Qed.

(* A point at distance at most the offset from the bisector of two points. *)
Lemma reach_bisector z a b g : a <> b -> 0 <= g -> dist2 z b - dist2 z a <= g * (2 * dist a b) ->
  exists y, dist z y <= g /\ dist y b <= dist y a.
Proof.
  intros D G H. pose proof (dist_pos a b D) as P. set (d := dist a b) in *.
  set (u := ((fst b - fst a) / d, (snd b - snd a) / d)).
  exists (fst z + g * fst u, snd z + g * snd u).
  assert (U : fst u * fst u + snd u * snd u = 1).
  { apply (Rmult_eq_reg_l (d * d)); [| apply Rmult_integral_contrapositive_currified; lra]. rewrite Rmult_1_r. unfold d at 3 4. rewrite dist_sq.
    unfold u, dist2. simpl. field. lra. }
  assert (F : fst u * (fst b - fst a) + snd u * (snd b - snd a) = d).
  { replace (fst b - fst a) with (d * fst u) by (unfold u; simpl; field; lra).
    replace (snd b - snd a) with (d * snd u) by (unfold u; simpl; field; lra).
    transitivity (d * (fst u * fst u + snd u * snd u)); [ring | rewrite U; ring]. }
  clearbody u. split.
  - apply le_of_squares; [exact G |]. rewrite dist_sq. unfold dist2. simpl.
    replace (_ + _) with (g * g * (fst u * fst u + snd u * snd u)) by ring. rewrite U. lra.
  - apply dist_le.
    assert (E : dist2 (fst z + g * fst u, snd z + g * snd u) b - dist2 (fst z + g * fst u, snd z + g * snd u) a
      = dist2 z b - dist2 z a - 2 * g * (fst u * (fst b - fst a) + snd u * (snd b - snd a))).
    { unfold dist2. simpl. ring. }
    rewrite F in E. lra.
Qed.

(* V, Hausdorff: if z is undetermined, and every pair (i,j) that shares z has disjoint rectangles and either
   (diam R_i + diam R_j) (dl_i(z) + dl_j(z)) <= 2 h dist(R_i,R_j), or dl_i(z) and dl_j(z) at most h, then the true diagram
   is within h of z, for every choice. *)
Theorem voronoi_hausdorff N B p z h : (2 <= N)%nat -> 0 <= h -> choice N B p -> undetermined N B z ->
  (forall i j, (i < N)%nat -> (j < N)%nat -> i <> j -> neighbours_at N B i j z ->
    exists s, 0 < s /\ (forall x y, inside x (B i) -> inside y (B j) -> s <= dist x y) /\
      ((exists di dj, diameter_le (B i) di /\ diameter_le (B j) dj /\
         (di + dj) * (dl z (B i) + dl z (B j)) <= 2 * h * s) \/
       (dl z (B i) <= h /\ dl z (B j) <= h))) ->
  exists w, diagram N p w /\ dist z w <= h.
Proof.
  intros H2 H0 P U H.
  destruct (finite_min (fun _ => True) (fun k => dist z (p k)) N) as [i [I [_ Li]]].
  { exists 0%nat. split; [lia | exact Logic.I]. }
  assert (C : cell N p i z) by (intros k K; now apply Li).
  destruct (finite_min (fun k => k <> i) (fun k => ds z (B k)) N) as [j [J [D Lj]]].
  { destruct i; [exists 1%nat | exists 0%nat]; lia. }
  assert (W : ds z (B j) <= dl z (B i)).
  { apply NNPP. intros X. apply (U i I). intros k K Dk. pose proof (Lj k K Dk). lra. }
  assert (Q : neighbours_at N B i j z).
  { split; [apply pos_exact; [exact I | now exists p] |]. intros k K.
    destruct (Nat.eq_dec k i) as [-> | Dk]; [exact W |]. pose proof (Lj k K Dk). pose proof (ds_le_dl z (B k)). lra. }
  destruct (H i j I J (not_eq_sym D) Q) as [s [S [Sep M]]].
  pose proof (Sep _ _ (P i I) (P j J)) as Far.
  assert (Ne : p i <> p j) by (intros E; rewrite E, dist_self in Far; lra).
  assert (Way : exists y, dist z y <= h /\ dist y (p j) <= dist y (p i)).
  { destruct M as [[di [dj [Di [Dj M]]]] | [_ M]].
    - (* |z - p_j| - |z - p_i| <= di + dj, and the sum of the two is at most dl_i + dl_j *)
      assert (A1 : dist z (p j) <= ds z (B j) + dj).
      { pose proof (dist_triangle z (nearest z (B j)) (p j)). pose proof (Dj _ _ (nearest_inside z (B j)) (P j J)).
        unfold ds. lra. }
      assert (A2 : dl z (B i) <= dist z (p i) + di).
      { pose proof (dist_triangle z (p i) (farthest z (B i))). pose proof (Di _ _ (P i I) (farthest_inside z (B i))).
        unfold dl. lra. }
      pose proof (le_dl z _ _ (P i I)) as A3. pose proof (le_dl z _ _ (P j J)) as A4. pose proof (C j J) as A5.
      apply reach_bisector; [exact Ne | exact H0 |]. rewrite <- !dist_sq. pose proof (dist_nonneg z (p i)).
      replace (dist z (p j) * dist z (p j) - dist z (p i) * dist z (p i))
        with ((dist z (p j) - dist z (p i)) * (dist z (p j) + dist z (p i))) by ring.
      apply Rle_trans with ((di + dj) * (dl z (B i) + dl z (B j))); [apply Rmult_le_compat; lra |].
      apply Rle_trans with (2 * h * s); [exact M |].
      assert (h * s <= h * dist (p i) (p j)) by (apply Rmult_le_compat_l; lra). lra.
    - exists (p j). rewrite dist_self. split; [| apply dist_nonneg].
      pose proof (le_dl z _ _ (P j J)). lra. }
  destruct Way as [y [Y1 Y2]].
  destruct (way_meets_diagram N p i j z y I J (not_eq_sym Ne) C Y2) as [t [T G]].
  exists (mix t z y). split; [exact G |]. rewrite dist_mix_left by lra. pose proof (dist_nonneg z y).
  assert (t * dist z y <= 1 * dist z y) by (apply Rmult_le_compat_r; lra). lra.
Qed.

(* ---- where rectangles meet ---- *)

(* A chosen point other than the nearest is not nearer to z than the diagram. *)
Lemma other_point_near N p i k z h : (i < N)%nat -> (k < N)%nat -> cell N p i z -> p k <> p i -> dist z (p k) <= h ->
  exists w, diagram N p w /\ dist z w <= h.
Proof.
  intros I K C D H.
  destruct (way_meets_diagram N p i k z (p k) I K D C) as [t [T G]]; [rewrite dist_self; apply dist_nonneg |].
  exists (mix t z (p k)). split; [exact G |]. rewrite dist_mix_left by lra. pose proof (dist_nonneg z (p k)).
  assert (t * dist z (p k) <= 1 * dist z (p k)) by (apply Rmult_le_compat_r; lra). lra.
Qed.

Definition apart (A B : rect) : Prop := forall x, inside x A -> ~ inside x B.

Lemma apart_differ N B p i k : choice N B p -> (i < N)%nat -> (k < N)%nat -> apart (B i) (B k) -> p k <> p i.
Proof. intros P I K A E. apply (A (p i) (P i I)). rewrite <- E. now apply P. Qed.

(* The true diagram is within h of z if for every site that is possibly nearest to z there is a rectangle apart from its
   own with dl at most h, or are two such rectangles that are apart from one another. *)
Theorem voronoi_second N B p z h : (1 <= N)%nat -> choice N B p ->
  (forall i, (i < N)%nat -> pos N B i z ->
    (exists k, (k < N)%nat /\ apart (B i) (B k) /\ dl z (B k) <= h) \/
    (exists k l, (k < N)%nat /\ (l < N)%nat /\ apart (B k) (B l) /\ dl z (B k) <= h /\ dl z (B l) <= h)) ->
  exists w, diagram N p w /\ dist z w <= h.
Proof.
  intros N1 P H.
  destruct (finite_min (fun _ => True) (fun k => dist z (p k)) N) as [i [I [_ Li]]].
  { exists 0%nat. split; [lia | exact Logic.I]. }
  assert (C : cell N p i z) by (intros k K; now apply Li).
  assert (Near : forall k, (k < N)%nat -> dl z (B k) <= h -> p k <> p i -> exists w, diagram N p w /\ dist z w <= h).
  { intros k K L D. apply (other_point_near N p i k); auto. pose proof (le_dl z _ _ (P k K)). lra. }
  destruct (H i I) as [[k [K [A L]]] | [k [l [K [L [A [Dk Dl]]]]]]].
  - apply pos_exact; [exact I | now exists p].
  - apply (Near k K L). now apply (apart_differ N B p i k).
  - destruct (classic (p k = p i)) as [E | E]; [| now apply (Near k)].
    apply (Near l L Dl). rewrite <- E. now apply (apart_differ N B p k l).
Qed.
