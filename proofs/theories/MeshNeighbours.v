(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* In a Delaunay triangulation, ties allowed, a nearest site is joined by an edge: who is as near as all neighbours in
  the
   mesh is as near as all others. *)
From Coq Require Import Reals Lra Lia Psatz Classical List.
From Dyadel Require Import Plane Distance Cells Orientation Disc TiedRim Triangulation Inserted.
Open Scope R_scope.

(* Those of a list of which something is so. *)
Lemma sublist {A} (P : A -> Prop) (l : list A) : exists k, forall x, In x k <-> In x l /\ P x.
Proof.
  induction l as [| y l [k H]]; [exists nil; simpl; tauto |].
  destruct (classic (P y)) as [Y | Y]; [exists (y :: k) | exists k]; intros x; simpl; rewrite H; [| split].
  - split; [intros [<- | [X Q]]; auto | intros [[<- | X] Q]; auto].
  - intros [X Q]. auto.
  - intros [[<- | X] Q]; [contradiction | auto].
Qed.

Section Mesh.
Variables (N : nat) (p : nat -> point) (T : mesh).
Variable skeleton : delaunay N p (fun k => (k < N)%nat) T.
Variable distinct : forall v w, (v < N)%nat -> (w < N)%nat -> v <> w -> p v <> p w.

Lemma turned a b c : T a b c -> T b c a.
Proof. intros F. now destruct (proj1 skeleton _ _ _ F). Qed.

Lemma corner_below a b c : T a b c -> (a < N)%nat \/ a = N.
Proof. intros F. now destruct (proj1 skeleton _ _ _ F) as (_ & _ & X & _). Qed.

(* A hull edge: nobody is beyond it. *)
Lemma nobody_beyond a b z : T a b N -> (a < N)%nat -> (b < N)%nat -> (z < N)%nat -> orient (p a) (p b) (p z) <= 0.
Proof.
  intros F A C Z. destruct (proj1 skeleton _ _ _ F) as (_ & _ & _ & _ & H). specialize (H z Z). unfold test in H.
  destruct (Nat.eqb_spec a N); [lia |]. destruct (Nat.eqb_spec b N); [lia |]. now rewrite Nat.eqb_refl in H.
Qed.

(* The circle of a triangle is empty. *)
Lemma mesh_circle a b c : T a b c -> (a < N)%nat -> (b < N)%nat -> (c < N)%nat ->
  0 < orient (p a) (p b) (p c) /\ exists o, about o (p a) (p b) = 0 /\ about o (p a) (p c) = 0 /\
    forall z, (z < N)%nat -> 0 <= about o (p a) (p z).
Proof.
  intros F A C D. destruct (proj1 skeleton _ _ _ F) as (_ & _ & _ & O & H). specialize (O A C D). split; [exact O |].
  destruct (centre_of (p a) (p b) (p c) O) as (o & X & Y & E). exists o. split; [exact X |]. split; [exact Y |].
  intros z Z. specialize (H z Z). unfold test in H. destruct (Nat.eqb_spec a N); [lia |].
  destruct (Nat.eqb_spec b N); [lia |]. destruct (Nat.eqb_spec c N); [lia |]. rewrite E in H.
  apply Rnot_lt_le. intros L. assert (0 < orient (p a) (p b) (p c) * - about o (p a) (p z)) by (apply
    Rmult_lt_0_compat; lra).
  lra.
Qed.

(* The triangles at a site are a fan round it, up to the hull. *)
Lemma mesh_fan a b c : T a b c -> (a < N)%nat -> (b < N)%nat -> (c < N)%nat ->
  exists faces, fan_round N p a faces /\ forall x y, In (x, y) faces -> T a x y /\ (x < N)%nat /\ (y < N)%nat.
Proof.
  intros F A C D. destruct (sublist (fun e => T a (fst e) (snd e)) (list_prod (seq 0 N) (seq 0 N))) as [faces H].
  assert (I : forall x y, In (x, y) faces <-> T a x y /\ (x < N)%nat /\ (y < N)%nat).
  { intros x y. rewrite H, in_prod_iff, !in_seq. simpl. split; [intros [[X Y] G] | intros (G & X & Y)]; repeat split;
    auto; lia. }
  exists faces. split; [| intros x y; apply I]. split.
  { intros E. assert (X : In (b, c) faces) by (apply I; auto). now rewrite E in X. }
  intros x y G. apply I in G as (G & X & Y). split; [now split |]. split; [now apply mesh_circle |].
  destruct skeleton as (_ & _ & Next & _). split.
  - destruct (Next a x y G) as [d K]. pose proof (turned _ _ _ K) as K1. pose proof (turned _ _ _ K1) as K2.
    destruct (corner_below _ _ _ K2) as [Dn | ->].
    + left. exists d. now apply I.
    + right. intros m M. pose proof (nobody_beyond x a m K X A M) as Q. unfold orient in *. lra.
  - pose proof (turned _ _ _ (turned _ _ _ G)) as G2. destruct (Next _ _ _ G2) as [d K].
    pose proof (turned _ _ _ (turned _ _ _ K)) as K2. destruct (corner_below _ _ _ K2) as [Dn | ->].
    + left. exists d. now apply I.
    + right. intros m M. pose proof (nobody_beyond a y m K A Y M) as Q. unfold orient in *. lra.
Qed.

(* In the cone of a triangle, nearer than both other corners: inside of its circle. *)
Lemma inside_circle o a b c z : 0 < orient a b c -> about o a b = 0 -> about o a c = 0 -> z <> a ->
  0 <= orient a b z -> 0 <= orient a z c -> dist a z < dist a b -> dist a z < dist a c -> about o a z < 0.
Proof.
  intros D Eb Ec Dz Zb Zc Lb Lc. set (n := orient a b c) in *. set (s := orient a z c) in *.
    set (t := orient a b z) in *.
  assert (X : n * (fst z - fst a) = s * (fst b - fst a) + t * (fst c - fst a)) by (unfold n, s, t, orient; ring).
  assert (Y : n * (snd z - snd a) = s * (snd b - snd a) + t * (snd c - snd a)) by (unfold n, s, t, orient; ring).
  pose proof (dist_pos a z (not_eq_sym Dz)) as P.
  assert (Ab : forall v, about o a v = dist2 a v - 2 * ((fst o - fst a) * (fst v - fst a) + (snd o - snd a) * (snd v -
    snd a)))
    by (intros; unfold about, dist2; ring).
  (* n |z|^2 is at most |z| (s |b| + t |c|) *)
  assert (Dot : forall v, (fst z - fst a) * (fst v - fst a) + (snd z - snd a) * (snd v - snd a) <= dist a z * dist a v).
  { intros v. apply le_of_squares; [apply Rmult_le_pos; apply dist_nonneg |].
    replace (dist a z * dist a v * (dist a z * dist a v)) with ((dist a z * dist a z) * (dist a v * dist a v)) by ring.
    rewrite !dist_sq. unfold dist2.
    pose proof (Rle_0_sqr ((fst z - fst a) * (snd v - snd a) - (snd z - snd a) * (fst v - fst a))) as Q.
      unfold Rsqr in Q. nra. }
  pose proof (Dot b) as Db. pose proof (Dot c) as Dc. rewrite Ab in Eb, Ec |- *.
  assert (Nz : n * dist2 a z = s * ((fst z - fst a) * (fst b - fst a) + (snd z - snd a) * (snd b - snd a)) +
    t * ((fst z - fst a) * (fst c - fst a) + (snd z - snd a) * (snd c - snd a))).
  { transitivity ((fst z - fst a) * (n * (fst z - fst a)) + (snd z - snd a) * (n * (snd z - snd a))); [unfold dist2;
    ring |].
    rewrite X, Y. ring. }
  assert (No : n * ((fst o - fst a) * (fst z - fst a) + (snd o - snd a) * (snd z - snd a)) =
    s * ((fst o - fst a) * (fst b - fst a) + (snd o - snd a) * (snd b - snd a)) +
    t * ((fst o - fst a) * (fst c - fst a) + (snd o - snd a) * (snd c - snd a))).
  { transitivity ((fst o - fst a) * (n * (fst z - fst a)) + (snd o - snd a) * (n * (snd z - snd a))); [ring |].
    rewrite X, Y. ring. }
  assert (Sb : dist a z * dist a b < dist2 a b) by (rewrite <- dist_sq; apply Rmult_lt_compat_r; lra).
  assert (Sc : dist a z * dist a c < dist2 a c) by (rewrite <- dist_sq; apply Rmult_lt_compat_r; lra).
  assert (Pos : 0 < s \/ 0 < t).
  { destruct (Rle_lt_or_eq_dec 0 s Zc) as [Q | Q]; [now left |]. destruct (Rle_lt_or_eq_dec 0 t Zb) as [Q' | Q'];
    [now right |].
    exfalso. rewrite <- Q, <- Q' in X, Y. apply Dz. rewrite (surjective_pairing z), (surjective_pairing a).
    f_equal; apply (Rmult_eq_reg_l n); lra. }
  set (eb := (fst z - fst a) * (fst b - fst a) + (snd z - snd a) * (snd b - snd a)) in *.
  set (ec := (fst z - fst a) * (fst c - fst a) + (snd z - snd a) * (snd c - snd a)) in *.
  set (ob := (fst o - fst a) * (fst b - fst a) + (snd o - snd a) * (snd b - snd a)) in *.
  set (oc := (fst o - fst a) * (fst c - fst a) + (snd o - snd a) * (snd c - snd a)) in *.
  set (oz := (fst o - fst a) * (fst z - fst a) + (snd o - snd a) * (snd z - snd a)) in *.
  apply (Rmult_lt_reg_l n); [exact D |]. rewrite Rmult_0_r.
  replace (n * (dist2 a z - 2 * oz)) with (n * dist2 a z - 2 * (n * oz)) by ring. rewrite Nz, No.
  assert (Wb : eb < 2 * ob) by lra. assert (Wc : ec < 2 * oc) by lra.
  assert (s * eb <= s * (2 * ob)) by (apply Rmult_le_compat_l; lra).
  assert (t * ec <= t * (2 * oc)) by (apply Rmult_le_compat_l; lra).
  destruct Pos as [Q | Q].
  - assert (s * eb < s * (2 * ob)) by (apply Rmult_lt_compat_l; lra). lra.
  - assert (t * ec < t * (2 * oc)) by (apply Rmult_lt_compat_l; lra). lra.
Qed.

(* s is joined to a in the mesh. *)
Definition next_to (a s : nat) : Prop := (s < N)%nat /\ exists c, T a s c.

Theorem nearest_beside a b c k : T a b c -> (a < N)%nat -> (b < N)%nat -> (c < N)%nat -> (k < N)%nat -> k <> a ->
  exists s, next_to a s /\ dist (p a) (p s) <= dist (p a) (p k).
Proof.
  intros F A C D K Dk. destruct (mesh_fan a b c F A C D) as (faces & Fan & Real).
  destruct (sites_covered N p a faces Fan k A K (distinct k a K A Dk)) as (x & y & G & Ox & Oy).
  destruct (Real x y G) as (Q & X & Y). destruct (mesh_circle a x y Q A X Y) as (O & o & Ex & Ey & Out).
  destruct (Rle_dec (dist (p a) (p x)) (dist (p a) (p k))) as [L | L].
  { exists x. split; [split; [exact X | now exists y] | exact L]. }
  destruct (Rle_dec (dist (p a) (p y)) (dist (p a) (p k))) as [M | M].
  { exists y. split; [split; [exact Y |] | exact M]. destruct skeleton as (_ & _ & Next & _).
    destruct (Next _ _ _ (turned _ _ _ (turned _ _ _ Q))) as [d H]. now exists d. }
  exfalso. pose proof (inside_circle o (p a) (p x) (p y) (p k) O Ex Ey (distinct k a K A Dk) Ox Oy ltac:(lra)
    ltac:(lra)).
  specialize (Out k K). lra.
Qed.
End Mesh.
